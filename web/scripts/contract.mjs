// npm run contract: writes src/contract/ from the output of `armloom schema --openapi`: types.ts
// for the compiler, schemas.json for the validation of messages at run time. Both files are in the
// repository; a test checks that they are up to date.
//
//   ARMLOOM_BINARY    the program, default ../build/armloom
//   --check           writes nothing; exits with 1 if a file is out of date
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import openapi_types, { astToString } from 'openapi-typescript';

const kWeb = resolve(dirname(fileURLToPath(import.meta.url)), '..');
const kBinary = resolve(process.env.ARMLOOM_BINARY ?? join(kWeb, '../build/armloom'));
const kHead = '// Written by `npm run contract`: change the descriptions in server/messages, not this file.\n';
// The schemas of the messages that the page reads. Schemas to which they refer are added.
const kRead = ['Message', 'Cell', 'Job', 'Diagram', 'Timeline', 'Problem', 'Verdict', 'JobMotion', 'Plan', 'AlertList', 'Session', 'Comparison', 'Control', 'ControlTaken', 'Jog', 'JobPage', 'MeasuredStates', 'RecordingList', 'Fault', 'FaultRequest'];
// Keywords that the page does not check, so that a newer server may send more than this page knows.
const kDropped = new Set(['description', 'additionalProperties', 'minimum', 'maximum', 'exclusiveMinimum', 'exclusiveMaximum', 'pattern', 'format', 'dependentRequired']);
// Large arrays. They are validated where they are used (src/motion, src/state/trace), because a
// second check would delay the page.
const kReadWhereUsed = { JobMotion: 'trajectory', MeasuredStates: 'q' };

const document = JSON.parse(execFileSync(kBinary, ['schema', '--openapi'], { encoding: 'utf8', maxBuffer: 1 << 26 }));

function shape_of(schema, names, in_properties = false) {
  if (Array.isArray(schema)) return schema.map((element) => shape_of(element, names));
  if (typeof schema !== 'object' || schema === null) return schema;
  const out = {};
  for (const [key, value] of Object.entries(schema)) {
    if (!in_properties && kDropped.has(key) && value !== schema.properties) {
      if (key !== 'additionalProperties' || value === false) continue;
    }
    if (key === '$ref') {
      const name = value.split('/').at(-1);
      names.add(name);
      out.$ref = `#/$defs/${name}`;
    } else {
      out[key] = key === 'discriminator' ? value : shape_of(value, names, key === 'properties' && !in_properties);
    }
  }
  return out;
}

const names = new Set(kRead);  // schemas_text() adds the schemas to which these refer

function schemas_text() {
  const shapes = {};
  for (const name of names) {
    const schema = structuredClone(document.components.schemas[name]);
    if (kReadWhereUsed[name]) schema.properties[kReadWhereUsed[name]] = {};
    shapes[name] = shape_of(schema, names);
  }
  const lines = Object.entries(shapes).map(([name, shape]) => `"${name}": ${JSON.stringify(shape)}`);
  return `{\n${lines.join(',\n')}\n}\n`;
}

// Removes minItems and maxItems unless they are equal, because the generator supports only arrays
// of fixed length.
function without_ranges(schema) {
  if (typeof schema !== 'object' || schema === null) return schema;
  if (Array.isArray(schema)) return schema.map(without_ranges);
  const { minItems, maxItems, ...rest } = schema;
  const plain = Object.fromEntries(Object.entries(rest).map(([key, value]) => [key, without_ranges(value)]));
  return minItems !== undefined && minItems === maxItems ? { ...plain, minItems, maxItems } : plain;
}

async function types_text() {
  const schemas = Object.fromEntries([...names].map((name) => [name, without_ranges(document.components.schemas[name])]));
  const ast = await openapi_types({ ...document, paths: {}, components: { schemas } }, { arrayLength: true });
  return kHead + astToString(ast);
}

const files = { 'schemas.json': schemas_text(), 'types.ts': await types_text() };
const stale = [];
for (const [name, text] of Object.entries(files)) {
  const file = join(kWeb, 'src/contract', name);
  if (!process.argv.includes('--check')) writeFileSync(file, text);
  else if (readFileSync(file, 'utf8') !== text) stale.push(name);
}
if (stale.length) {
  console.error(`web/src/contract: ${stale.join(', ')} not as the server has it; run \`npm run contract\` in web`);
  process.exit(1);
}
