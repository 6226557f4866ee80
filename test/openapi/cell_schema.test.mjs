// config/cell.schema.json as editors use it: a valid schema that accepts every cell of this repository and
// refuses what the cell reader refuses.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';
import {test} from 'node:test';
import {fileURLToPath} from 'node:url';

const top = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../..');
const require = createRequire(new URL('../../web/package.json', import.meta.url));
const Ajv = require('ajv/dist/2020').default;

const config = path.join(top, 'config');
const schema = JSON.parse(fs.readFileSync(path.join(config, 'cell.schema.json'), 'utf8'));
const ajv = new Ajv({strict: true, strictTypes: false, strictRequired: false, allErrors: true});
const fits = ajv.compile(schema);

// Comments in these cells are on separate lines.
const read = (file) => JSON.parse(fs.readFileSync(path.join(config, file), 'utf8').replace(/^\s*\/\/.*$/gm, ''));
const cells = fs.readdirSync(config).filter((file) =>
  file.endsWith('.json') && !file.endsWith('_jobs.json') && !file.endsWith('.schema.json'));

test('every cell of the repository names the schema and fits it', () => {
  assert.ok(cells.length >= 5, `only ${cells.length} cells`);
  for (const file of cells) {
    const cell = read(file);
    assert.equal(cell.$schema, 'cell.schema.json', file);
    assert.ok(fits(cell), `${file}: ${ajv.errorsText(fits.errors)}`);
  }
});

const bad = [
  ['an unknown field', (c) => { c.robots[0].urfd = 'x'; }],
  ['no name', (c) => { delete c.name; }],
  ['no robot', (c) => { c.robots = []; }],
  ['a short position', (c) => { c.robots[0].base.xyz = [1, 2]; }],
  ['a home that is a number', (c) => { c.robots[0].arms[0].home = 7; }],
  ['a limit of zero', (c) => { c.robots[0].arms[0].limits.panda_joint1 = {brake_rad_s2: 0}; }],
  ['a limit twice', (c) => { c.robots[0].arms[0].limits.panda_joint1 = {jerk_rad_s3: 1, jerk_m_s3: 1}; }],
  ['a flat box', (c) => { c.objects[0].box = [1, 1, 0]; }],
  ['two shapes', (c) => { c.objects[0].sphere = [1]; }],
  ['no shape', (c) => { delete c.objects[0].box; }],
  ['a scale without a mesh', (c) => { c.objects[0].scale = [1, 1, 1]; }],
  ['a single name that may touch', (c) => { c.allowed_collisions = [['table']]; }],
  ['an unknown policy', (c) => { c.scheduling.policy = 'hopeful'; }],
  ['a setting out of range', (c) => { c.monitor.rate_hz = 5000; }],
];
for (const [what, spoil] of bad) {
  test(`It refuses ${what}`, () => {
    const cell = read('two_pandas.json');
    spoil(cell);
    assert.ok(!fits(cell));
  });
}

test('accepts joint limits files, fixed joints and named homes', () => {
  const cell = read('two_pandas.json');
  Object.assign(cell.robots[0], {joint_limits: 'joint_limits.yaml', fixed: {torso: 0.1}});
  Object.assign(cell.robots[0].arms[0], {home: 'ready', limits: {panda_joint1: {velocity_rad_s: 1, lower_rad: -1}}});
  cell.objects.push({name: 'part', mesh: 'part.stl', scale: [1, 1, 1]});
  assert.ok(fits(cell), ajv.errorsText(fits.errors));
});
