// Request schemas must agree with the readers: of thousands of values, good and bad (schema_cases.cc), each
// schema accepts exactly those that its reader accepts.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {createRequire} from 'node:module';
import {test} from 'node:test';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const Ajv = require('ajv/dist/2020').default;
const formats = JSON.parse(execFileSync(process.env.SCHEMA_CASES, {encoding: 'utf8', maxBuffer: 1 << 28}));

// Returns the keys of all members that the schema lists.
function keysOf(schema, keys = new Set()) {
  if (schema === null || typeof schema !== 'object') return keys;
  if (schema.type === 'object') Object.keys(schema.properties ?? {}).forEach((key) => keys.add(key));
  Object.values(schema).forEach((inner) => keysOf(inner, keys));
  return keys;
}
function keysIn(value, keys) {
  if (value === null || typeof value !== 'object') return;
  for (const [key, member] of Object.entries(value)) {
    keys.add(key);
    keysIn(member, keys);
  }
}

// Members of steps are tried in values of the format StepRequest: in values of jobs they are too rare.
const inSteps = new Set();
const stepsFirst = (a, b) => Number(b[0] === 'StepRequest') - Number(a[0] === 'StepRequest');

for (const [name, {schema, cases}] of Object.entries(formats).sort(stepsFirst)) {
  test(`${name}: the schema accepts exactly what the reader accepts`, () => {
    const ajv = new Ajv({strict: true, strictRequired: false, strictTypes: false});
    const fits = ajv.compile(schema);
    const differ = [];
    const seen = new Set();
    let taken = 0;
    for (const {text, fault} of cases) {
      const value = JSON.parse(text);
      if (fits(value) !== (fault === null)) {
        differ.push(`${text.slice(0, 300)}\n  reader: ${fault ?? 'taken'}\n  schema: ${ajv.errorsText(fits.errors)}`);
      }
      if (fault !== null) continue;
      ++taken;
      keysIn(value, seen);
    }
    console.log(`${name}: ${cases.length} values, ${taken} taken`);
    assert.equal(differ.length, 0, `${differ.length} differ, as\n${differ.slice(0, 5).join('\n')}`);
    assert.ok(taken > 100 && cases.length - taken > 100, `${taken} of ${cases.length} taken: one side is hardly tried`);
    if (name === 'StepRequest') seen.forEach((key) => inSteps.add(key));
    const untried = [...keysOf(schema)].filter((key) => !seen.has(key) && !inSteps.has(key));
    assert.deepEqual(untried, [], 'members that no value that was taken had');
  });
}

const arraysWithoutItems = (schema, at = '') => {
  if (schema === null || typeof schema !== 'object') return [];
  const here = [schema.type].flat().includes('array') && schema.items === undefined ? [at] : [];
  return here.concat(...Object.entries(schema).map(([key, inner]) => arraysWithoutItems(inner, `${at}/${key}`)));
};
test('every array schema has items', () => {
  const document = JSON.parse(execFileSync(process.env.ARMLOOM_BINARY, ['schema', '--openapi'], {encoding: 'utf8'}));
  assert.deepEqual(arraysWithoutItems(document), []);
  for (const {schema} of Object.values(formats)) assert.deepEqual(arraysWithoutItems(schema), []);
});
