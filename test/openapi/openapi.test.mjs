// Checks that /openapi.json is complete and true. Every operation is called with good and bad requests until each
// listed status was seen (of 503 and 507, which need a server in distress, only a few). Every response and message is
// checked against its schema. The good requests are the examples of the document. ARMLOOM_PRISM=node_modules/.bin/prism
// sends all calls through that proxy, which must not complain.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import {after, before, test} from 'node:test';

import {Contract} from './contract.mjs';
import {startPrism, violations} from './prism.mjs';
import {ask, handshake, openEvents, openWebSocket, startServer} from './server.mjs';

const top = path.resolve(import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname), '../..');
const binary = process.env.ARMLOOM_BINARY ?? path.join(top, 'build/armloom');
const v1 = '/api/v1';
const json = {'Content-Type': 'application/json'};
const tetrahedron = `v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n`;

let folder, server, proxy, contract, example;
let proxied = 0;
const streams = [];

// Writes the two-Panda cell with a mesh, so that a mesh is served.
function writeCell() {
  fs.writeFileSync(path.join(folder, 'tetrahedron.obj'), tetrahedron);
  fs.mkdirSync(path.join(folder, 'web'));
  fs.writeFileSync(path.join(folder, 'web/index.html'), '<!doctype html><title>dashboard</title>');
  const text = fs.readFileSync(path.join(top, 'config/two_pandas.json'), 'utf8')
    .replace(/\/\*[^]*?\*\//g, '').replace(/^\s*\/\/.*$|\s\/\/\s.*$/gm, '')
    .replaceAll('../models/', path.join(top, 'models') + '/');
  const cell = JSON.parse(text);
  cell.objects.push({name: 'tetrahedron', mesh: 'tetrahedron.obj', xyz: [0, 3, 0]});
  cell.scheduling.on_idle_blocker = 'report';  // waiting jobs must keep waiting
  // Nothing listens on port 1.
  cell.io = {devices: [{name: 'plc', endpoint: 'tcp:127.0.0.1:1'}],
             signals: [{name: 'lane', direction: 'input'}, {name: 'count', direction: 'output', type: 'integer'},
                       {name: 'door', direction: 'input', modbus: {device: 'plc', table: 'discrete_input', address: 0}},
                       {name: 'valve', direction: 'output', modbus: {device: 'plc', table: 'coil', address: 0}}]};
  fs.writeFileSync(path.join(folder, 'cell.json'), JSON.stringify(cell));
}

// Sends a request, checks the response against openapi.json, and requires the status.
async function call(status, method, template, {args = {}, query = '', body, headers = {}, raw, direct = !proxy || raw !== undefined, ...rest} = {}) {
  const target = template.replace(/\{(\w+)\}/g, (all, name) => encodeURIComponent(args[name])) + query;
  const text = raw ?? (body === undefined ? undefined : JSON.stringify(body));
  const answer = await ask((direct ? server : proxy).port, method, target,
                           {...rest, body: text, headers: {...(text === undefined ? {} : json), ...headers}});
  if (!direct) unopposed(`${method} ${target}`, answer);
  contract.answer(template, method, answer);
  assert.equal(answer.status, status, `${method} ${target}: ${answer.text.slice(0, 400)}`);
  // A body that fits the schema may still be wrong, but an accepted body must fit the schema.
  if (body !== undefined && status < 300) assert.ok(contract.fitsBody(template, method, body), `${method} ${target}: accepted, but not to the schema`);
  return answer.headers['content-type']?.includes('json') ? JSON.parse(answer.text) : answer.text;
}

// Expects no complaint of prism. Requests that the server refuses may be wrong.
function unopposed(what, answer) {
  const found = violations(answer);
  proxied += 1;
  assert.deepEqual(found.answer, [], `prism of the answer to ${what}`);
  if (answer.status < 300) assert.deepEqual(found.request, [], `prism of ${what}`);
}

async function until(what, condition) {
  const end = Date.now() + 120_000;
  for (;;) {
    const value = await condition();
    if (value) return value;
    assert.ok(Date.now() < end, `waited two minutes for ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}
const ended = (id) => until(`the end of ${id}`, async () => {
  const job = await call(200, 'GET', `${v1}/jobs/{id}`, {args: {id}});
  return job.result && job;
});

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), 'armloom-openapi-'));
  writeCell();
  server = await startServer(binary, ['--cell', path.join(folder, 'cell.json'), '--speed', process.env.ARMLOOM_PRISM ? '2' : '10', '--jog-lease', '5', '--web', path.join(folder, 'web')]);
  const {text} = await ask(server.port, 'GET', '/openapi.json');
  contract = new Contract(JSON.parse(text));
  if (process.env.ARMLOOM_PRISM) proxy = await startPrism(process.env.ARMLOOM_PRISM, contract.document, path.join(folder, 'openapi.json'), server.port);
  example = (template, method, name) => structuredClone(contract.document.paths[template][method.toLowerCase()]
    .requestBody.content['application/json'].examples[name].value);
});
after(() => {
  for (const stream of streams) stream.close();
  if (proxy) console.log(`${proxied} requests through prism`);
  proxy?.end();
  server?.end();
  fs.rmSync(folder, {recursive: true, force: true});
});

test('the document equals the output of the command, and its schemas compile', async () => {
  const file = JSON.parse(execFileSync(binary, ['schema', '--openapi'], {encoding: 'utf8'}));
  assert.deepEqual(await call(200, 'GET', '/openapi.json'), file);
  assert.match(file.openapi, /^3\.1\./);
  contract.compileAll();
  const ids = contract.operations().map(({operation}) => operation.operationId);
  assert.equal(new Set(ids).size, ids.length, 'an operationId occurs twice');
  for (const {path: template, method, operation} of contract.operations()) {
    const declared = (operation.parameters ?? []).filter((p) => p.in === 'path').map((p) => p.name);
    assert.deepEqual(declared, [...template.matchAll(/\{(\w+)\}/g)].map((m) => m[1]), template);
    for (const [type, content] of Object.entries(operation.requestBody?.content ?? {})) {
      assert.equal(type, 'application/json');
      for (const [name, {value}] of Object.entries(content.examples)) {
        assert.ok(contract.fitsBody(template, method, value), `example ${name} of ${method} ${template}`);
      }
    }
  }
});

test('subscribers get a snapshot and all events after it', async () => {
  const told = (value) => contract.message(value);
  let snapshot;
  streams.push(await openWebSocket(server.port, `${v1}/ws`, told));
  contract.saw(`${v1}/ws`, 'GET', 101);
  const events = await openEvents(server.port, `${v1}/events`, {}, ({id, data}) => {
    snapshot ??= data;
    assert.equal(id, `${data.stream}:${data.seq}`);
    told(data);
  });
  streams.push(events);
  contract.answer(`${v1}/events`, 'GET', {...events, text: ''});
  await until('the snapshot', () => snapshot);
  assert.equal(snapshot.type, 'snapshot');
  assert.equal(snapshot.data.io.length, 4);

  let again;
  streams.push(await openEvents(server.port, `${v1}/events?poses=1`, {'Last-Event-ID': `${snapshot.stream}:999999`},
                                ({data}) => { again ??= data; told(data); }));
  await until('a snapshot after a gap', () => again);
  assert.equal(again.data.gap, true);
});

test('read-only operations answer as documented', async () => {
  await call(200, 'GET', '/');
  await call(200, 'GET', `${v1}/alerts`);
  const seen = (status, body) => call(status, 'POST', `${v1}/alerts/acknowledge`, {body});
  await seen(200, example(`${v1}/alerts/acknowledge`, 'POST', 'none'));
  await seen(404, {ids: ['x:1']});
  await seen(422, {ids: [], who: 'a\nb'});
  await call(404, 'GET', `${v1}/audit-log`);
  await call(422, 'GET', `${v1}/audit-log`, {query: '?limit=0'});
  for (const part of ['/docs', '/docs.css', '/docs.js', '/login', '/login.js']) await call(200, 'GET', part);
  const schema = JSON.parse(fs.readFileSync(path.join(top, 'config/cell.schema.json'), 'utf8'));
  assert.deepEqual(await call(200, 'GET', '/cell.schema.json'), schema);
  await call(200, 'GET', '/healthz');
  await call(200, 'GET', '/readyz');
  await call(200, 'GET', '/metrics');
  const cell = await call(200, 'GET', `${v1}/cell`);
  const mesh = cell.objects.find((object) => object.mesh).mesh;
  await call(200, 'GET', `${v1}/cell/meshes/{name}`, {args: {name: path.basename(mesh)}});
  await call(404, 'GET', `${v1}/cell/meshes/{name}`, {args: {name: '0123456789abcdef.stl'}});
  await call(200, 'GET', `${v1}/arms`);
  await call(200, 'GET', `${v1}/arms/{name}`, {args: {name: 'left'}});
  await call(404, 'GET', `${v1}/arms/{name}`, {args: {name: 'no body'}});
  await call(200, 'GET', `${v1}/states`);
  assert.equal((await call(200, 'GET', `${v1}/recordings`)).kept, false);
  await call(404, 'GET', `${v1}/recordings/{name}/{file}`, {args: {name: 'data', file: 'events.jsonl'}});
  await call(200, 'GET', `${v1}/queue`);
  await call(200, 'GET', `${v1}/timeline`);
  await call(200, 'GET', `${v1}/scene`);
  await call(200, 'GET', `${v1}/jobs`, {query: '?state=running&arm=left&limit=7'});
  for (const query of ['?limit=0', '?state=tired', '?arm=none', '?cursor=x']) {
    await call(422, 'GET', `${v1}/jobs`, {query});
  }
  await call(404, 'GET', `${v1}/jobs/{id}`, {args: {id: 'nothing'}});
  await call(404, 'GET', `${v1}/jobs/{id}/trajectory`, {args: {id: 'nothing'}});
});

test('good and bad jobs are answered as documented', async () => {
  await call(200, 'POST', `${v1}/check`, {body: example(`${v1}/check`, 'POST', 'reach')});
  for (const goal of ['named', 'pose']) {
    const plan = await call(200, 'POST', `${v1}/plan`, {body: example(`${v1}/plan`, 'POST', goal)});
    assert.equal(plan.verdict.verdict, 'free', JSON.stringify(plan));
  }
  const planned = await call(200, 'POST', `${v1}/plan`, {body: example(`${v1}/plan`, 'POST', 'steps')});
  assert.equal(planned.steps.length, 2);
  const twice = {steps: [{move_to: {named: 'ready'}, arm: 'left'}, {move_to: {pose: {xyz: [0, 9, 0.5]}}, arm: 'left'}]};
  const second = await call(422, 'POST', `${v1}/plan`, {body: twice});
  assert.equal(second.pointer, '/steps/1/move_to/pose');
  assert.equal(second.steps.length, 1);
  const checked = await call(200, 'POST', `${v1}/check`, {body: twice});
  assert.equal(checked.step, 1);
  const far = {pose: {link: 'left_panda_link8', xyz: [0, 9, 0.5], rpy: [0, 0, 0]}};
  const refusal = await call(422, 'POST', `${v1}/plan`, {body: {arm: 'left', to: far}});
  assert.match(refusal.type, /goal-not-reached/);
  const reach = example(`${v1}/jobs`, 'POST', 'reach');
  await call(202, 'POST', `${v1}/jobs`, {body: reach});
  await call(200, 'POST', `${v1}/jobs`, {body: reach});
  await call(409, 'POST', `${v1}/jobs`, {body: {...reach, priority: 7}});
  await call(409, 'POST', `${v1}/plan`, {body: {...twice, id: reach.id}});
  await call(409, 'POST', `${v1}/check`, {body: reach});
  await call(409, 'PUT', `${v1}/policy`, {body: {policy: 'sequential'}});  // a job is moving
  const right = (text) => JSON.parse(JSON.stringify(text).replaceAll('left_', 'right_'));
  const meet = {...right(reach), id: 'meet'};
  const verdict = await call(200, 'POST', `${v1}/check`, {body: {...meet, id: 'what-if'}});
  assert.equal(verdict.verdict, 'conflict');
  await call(202, 'POST', `${v1}/jobs`, {body: meet});
  await until('the reason why it waits', async () =>
    (await call(200, 'GET', `${v1}/queue`)).backlog.find((job) => job.waits_on.length > 0));
  const diagram = (status, query) => call(status, 'GET', `${v1}/jobs/{id}/diagram`, {args: {id: 'meet'}, query});
  const drawn = await diagram(200, '?with=reach');
  assert.deepEqual([drawn.a.id, drawn.b.id, drawn.layers[0].arms], ['meet', 'reach', ['right', 'left']]);
  const moves = await call(200, 'GET', `${v1}/jobs/{id}/trajectory`, {args: {id: 'reach'}});
  assert.deepEqual(moves.trajectory.joint_names, reach.trajectory.joint_names);
  const ahead = await diagram(200, '?with=reach&cells=0');
  assert.deepEqual([ahead.layers[0].cells, ahead.layers[0].first_contact.state], [undefined, 'conflict']);
  await diagram(400, '');
  await diagram(400, '?with=reach&cells=no');
  await diagram(404, '?with=nothing');
  await diagram(422, '?with=meet');
  const amend = (status, body, more) => call(status, 'PATCH', `${v1}/jobs/{id}`, {args: {id: 'meet'}, body, ...more});
  assert.equal((await amend(200, example(`${v1}/jobs/{id}`, 'PATCH', 'sooner'))).priority, 5);
  await amend(412, {priority: 6}, {headers: {'If-Match': '"nothing"'}});
  await amend(422, {priority: 1e9});
  await call(404, 'PATCH', `${v1}/jobs/{id}`, {args: {id: 'nothing'}, body: {priority: 1}});
  const stale = {args: {id: 'meet'}, headers: {'If-Match': '"nothing"'}};
  await call(412, 'POST', `${v1}/jobs/{id}/replan`, stale);
  await call(202, 'POST', `${v1}/jobs/{id}/replan`, {args: {id: 'meet'}});
  await call(412, 'DELETE', `${v1}/jobs/{id}`, stale);
  await call(202, 'DELETE', `${v1}/jobs/{id}`, {args: {id: 'meet'}});
  await call(409, 'DELETE', `${v1}/jobs/{id}`, {args: {id: 'meet'}});
  await amend(409, {priority: 1});
  await call(409, 'POST', `${v1}/jobs/{id}/replan`, {args: {id: 'meet'}});
  await call(404, 'POST', `${v1}/jobs/{id}/replan`, {args: {id: 'nothing'}});
  await call(404, 'DELETE', `${v1}/jobs/{id}`, {args: {id: 'nothing'}});
  await call(202, 'POST', `${v1}/jobs`, {body: example(`${v1}/jobs`, 'POST', 'moveit')});
  assert.equal((await ended('reach')).result.reason, 'completed');
  await ended('swing');
  await call(422, 'PUT', `${v1}/policy`, {body: {policy: 'best'}});
  const {policy} = await call(200, 'GET', `${v1}/cell`);
  await call(200, 'PUT', `${v1}/policy`, {body: example(`${v1}/policy`, 'PUT', 'coordinated')});
  assert.equal((await call(200, 'GET', `${v1}/cell`)).policy, 'coordinated');
  await call(200, 'PUT', `${v1}/policy`, {body: {policy}});
  const page = await call(200, 'GET', `${v1}/jobs`, {query: '?limit=1'});
  await call(200, 'GET', `${v1}/jobs`, {query: `?limit=1&cursor=${page.next_cursor}`});

  const broken = (change) => { const job = structuredClone(reach); delete job.id; change(job); return job; };
  const bad = [
    [422, broken((job) => { job.trajectory.joint_names[3] = 'elbow'; })],
    [422, broken((job) => { job.trajectory.points[1].positions[0] = 99; job.trajectory.points[1].positions[1] = 99; })],
    [422, broken((job) => { delete job.trajectory; })],
    [422, broken((job) => { delete job.trajectory.points[1].time_from_start; })],
    [422, broken((job) => { job.after = ['nothing']; })],
    [400, broken((job) => { job.priority = 'high'; })],
    [413, broken((job) => { job.trajectory.points = Array(10_001).fill(job.trajectory.points[0]); })]];
  for (const [status, body] of bad) await call(status, 'POST', `${v1}/jobs`, {body});
  for (const raw of ['', '{', '[1]', '{"id": "a", "id": "b"}', '{"id": 1e999}', '{"id": "\u0000"}']) {
    await call(400, 'POST', `${v1}/jobs`, {raw});
  }
  await call(413, 'POST', `${v1}/jobs`, {raw: '['.repeat(5000)});
});

test('jobs are compared under other policies', async () => {
  for (const method of ['GET', 'DELETE']) await call(404, method, `${v1}/comparison`);
  await call(409, 'POST', `${v1}/comparison`, {body: {since_s: 1e6}});
  const two = example(`${v1}/comparison`, 'POST', 'two');
  await call(202, 'POST', `${v1}/comparison`, {body: two});
  const done = await until('the comparison', async () => {
    const now = await call(200, 'GET', `${v1}/comparison`);
    return now.state === 'running' ? null : now;
  });
  assert.deepEqual([done.state, done.runs.map((run) => run.policy)], ['done', two.policies]);
  await call(200, 'DELETE', `${v1}/comparison`);
  await call(422, 'POST', `${v1}/comparison`, {body: {policies: ['best']}});
});

test('a client takes control and jogs an arm', async () => {
  const hold = `${v1}/arms/{name}/jog`;
  const left = {args: {name: 'left'}};
  await call(200, 'GET', `${v1}/control`);
  const {key} = await call(200, 'POST', `${v1}/control`, {body: example(`${v1}/control`, 'POST', 'ada')});
  await call(409, 'POST', `${v1}/control`, {body: {who: 'Bob'}});
  await call(422, 'POST', `${v1}/control`, {body: {who: '\n'}});
  const move = {...example(hold, 'POST', 'ready'), control: key};
  await call(409, 'POST', hold, {...left, body: {...move, control: 'foreign'}});
  await call(422, 'POST', hold, {...left, body: {...move, to: {named: 'nowhere'}}});
  await call(404, 'POST', hold, {args: {name: 'third'}, body: move});
  const {job} = await call(202, 'POST', hold, {...left, body: move});
  await call(200, 'PUT', hold, {...left, body: {control: key}});
  await call(409, 'PUT', hold, {...left, body: {control: 'foreign'}});
  await call(404, 'PUT', hold, {args: {name: 'third'}, body: {control: key}});
  await call(422, 'PUT', hold, {...left, body: {}});
  await ended(job.id);
  await call(409, 'PUT', hold, {...left, body: {control: key}});
  await call(409, 'POST', `${v1}/control/release`, {body: {control: 'foreign'}});
  await call(422, 'POST', `${v1}/control/release`, {body: {}});
  await call(200, 'POST', `${v1}/control/release`, {body: {control: key}});
});

test('good and bad batches are answered as documented', async () => {
  const at = `${v1}/batches`;
  // The motions of the example are changed to start where the arms are now.
  const batch = example(at, 'POST', 'both');
  const {arms} = await call(200, 'GET', `${v1}/arms`);
  for (const job of batch.jobs) {
    const arm = arms.find((candidate) => candidate.joints[0] === job.trajectory.joint_names[0]);
    const rest = (q) => ({...job.trajectory.points[0], positions: q});
    const from = arm.q.slice(0, 7);
    job.trajectory.points = [rest(from), {...rest(from.map((q, j) => (j === 0 ? q + (q > 0 ? -0.2 : 0.2) : q))), time_from_start: 4}];
  }
  const wrong = structuredClone(batch);
  wrong.jobs[1].trajectory.joint_names[0] = 'elbow';
  const refused = await call(422, 'POST', at, {body: wrong});
  assert.match(refused.pointer, /^\/jobs\/1\//);
  const taken = structuredClone(batch);
  taken.jobs[0].id = 'reach';
  await call(409, 'POST', at, {body: taken});
  assert.equal((await call(202, 'POST', at, {body: batch, headers: {'Idempotency-Key': 'both'}})).jobs.length, 2);
  assert.equal((await call(200, 'POST', at, {body: batch, headers: {'Idempotency-Key': 'both'}})).jobs.length, 2);
  wrong.jobs[0].id = 'batch-left-2';
  delete wrong.jobs[1].id;
  wrong.jobs[0].trajectory.points.forEach((point) => { point.positions = batch.jobs[0].trajectory.points[1].positions; });
  const mixed = await call(207, 'POST', at, {body: {...wrong, atomic: false}});
  assert.deepEqual(mixed.results.map((result) => result.status), [202, 422], JSON.stringify(mixed));
});

test('arms stop and resume', async () => {
  for (const verb of ['stop', 'resume']) {
    await call(202, 'POST', `${v1}/arms/{name}/${verb}`, {args: {name: 'left'}});
    await call(404, 'POST', `${v1}/arms/{name}/${verb}`, {args: {name: 'nobody'}});
  }
  assert.deepEqual(await call(202, 'POST', `${v1}/stop`), {stopped: true, category: 2});
  assert.deepEqual(await call(202, 'POST', `${v1}/resume`), {stopped: false});
  assert.deepEqual(await call(202, 'POST', `${v1}/stop`, {query: '?category=1'}), {stopped: true, category: 1});
  for (const path of [`${v1}/stop`, `${v1}/arms/{name}/stop`]) {
    for (const query of ['?category=7', '?categry=0', '?category=0&category=0']) {
      const wrong = await call(400, 'POST', path, {query, args: {name: 'left'}});
      assert.match(wrong.detail, /stopped with category 2/);
    }
  }
  const args = {name: 'left'};
  const has_link = async (link) => { while ((await call(200, 'GET', `${v1}/arms/{name}`, {args})).link !== link); };
  const fault = await call(201, 'POST', `${v1}/sim/faults`, {body: {arm: 'left', kind: 'drop_feedback'}});
  await has_link('lost');
  assert.match((await call(409, 'POST', `${v1}/arms/{name}/resume`, {args})).detail, /stays stopped/);
  assert.deepEqual(await call(202, 'POST', `${v1}/resume`), {stopped: false, not_resumed: ['left']});
  await call(204, 'DELETE', `${v1}/sim/faults/{id}`, {args: fault});
  await has_link('up');
  await call(202, 'POST', `${v1}/resume`);
});

test('speed override is set for the cell and for an arm', async () => {
  for (const [at, args] of [[`${v1}/speed`, {}], [`${v1}/arms/{name}/speed`, {name: 'left'}]]) {
    for (const speed_override of [-1, 0.0001, 2]) {
      const body = {speed_override};
      await call(422, 'PUT', at, {args, body});
      assert.ok(!contract.fitsBody(at, 'PUT', body), JSON.stringify(body));
    }
    const set = await call(200, 'PUT', at, {args, body: example(at, 'PUT', 'quarter')});
    assert.equal(set.speed_override, 0.25);
    assert.deepEqual(await call(200, 'GET', at, {args}), set);
    await call(200, 'PUT', at, {args, body: {speed_override: 1}});
  }
  await call(404, 'GET', `${v1}/arms/{name}/speed`, {args: {name: 'nobody'}});
  await call(404, 'PUT', `${v1}/arms/{name}/speed`, {args: {name: 'nobody'}, body: {speed_override: 1}});
});

test('signals are read and set', async () => {
  const at = `${v1}/io/{name}`;
  const put = (status, name, value) => call(status, 'PUT', at, {args: {name}, body: {value}});
  assert.equal((await put(200, 'lane', example(at, 'PUT', 'switch').value)).value, true);
  assert.equal((await put(200, 'count', example(at, 'PUT', 'register').value)).value, 250);
  const {signals} = await call(200, 'GET', `${v1}/io`);
  assert.deepEqual(signals.map(({value}) => value), [true, 250, null, null]);
  await put(404, 'nothing', true);
  await put(409, 'door', true);
  await put(503, 'valve', true);
  await put(422, 'lane', 1);
  await put(422, 'count', 70000);
});

test('objects are added, moved and removed', async () => {
  const rod = example(`${v1}/scene/objects`, 'POST', 'rod');
  await call(201, 'POST', `${v1}/scene/objects`, {body: rod});
  await call(409, 'POST', `${v1}/scene/objects`, {body: rod});
  await call(409, 'POST', `${v1}/scene/objects`, {body: {name: 'in the arm', box: [2, 2, 2], xyz: [0, 0, 1]}});
  const box = example(`${v1}/scene/objects/{name}`, 'PUT', 'box');
  await call(201, 'PUT', `${v1}/scene/objects/{name}`, {args: {name: 'a box'}, body: box});
  await call(200, 'PUT', `${v1}/scene/objects/{name}`, {args: {name: 'a box'}, body: {...box, name: 'a box', rpy: [0, 0, 1]}});
  await call(409, 'PUT', `${v1}/scene/objects/{name}`, {args: {name: 'a box'}, body: {box: [2, 2, 2], xyz: [0, 0, 1]}});
  await call(422, 'PUT', `${v1}/scene/objects/{name}`, {args: {name: 'a box'}, body: {...box, name: 'another'}});
  for (const body of [{name: 'm', mesh: '/etc/passwd'}, {name: 'n'}, {name: 'z', box: [0, 1, 1]}, {name: 'b', box: [1, 1, 1], sphere: [1]}]) {
    await call(422, 'POST', `${v1}/scene/objects`, {body});
    assert.ok(!contract.fitsBody(`${v1}/scene/objects`, 'POST', body), JSON.stringify(body));
  }
  const {version} = await call(200, 'GET', `${v1}/scene`);
  const gone = await call(200, 'DELETE', `${v1}/scene/objects/{name}`, {args: {name: 'rod'}});
  assert.ok(gone.version > version);
  await call(404, 'DELETE', `${v1}/scene/objects/{name}`, {args: {name: 'rod'}});
});

test('an operator lets go of an object that an arm holds', async () => {
  const object = `${v1}/scene/objects/{name}`;
  const part = {args: {name: 'part'}};
  await call(201, 'PUT', object, {...part, body: {box: [0.04, 0.04, 0.08], xyz: [-0.1, 0.35, 0.141]}});
  await call(409, 'POST', `${object}/detach`, part);
  await call(404, 'POST', `${object}/detach`, {args: {name: 'nothing'}});
  const pose = {link: 'left_panda_hand', xyz: [-0.1, 0.35, 0.25], rpy: [3.14159265, 0, 0.785]};
  const steps = [{arm: 'left', move_to: {pose}}, {attach: {object: 'part', link: 'left_panda_hand', touch: ['table']}},
    {arm: 'left', move_to: {named: 'home'}}];
  await call(202, 'POST', `${v1}/jobs`, {body: {id: 'hold', steps}});
  await ended('hold');
  await call(409, 'DELETE', object, part);
  await call(200, 'POST', `${object}/detach`, part);
  await call(200, 'DELETE', object, part);
});

test('all objects are set and removed at once', async () => {
  const stale = {headers: {'If-Match': '"nothing"'}};
  const body = example(`${v1}/scene`, 'PUT', 'voxels');
  const {version} = await call(200, 'PUT', `${v1}/scene`, {body});
  await call(409, 'PUT', `${v1}/scene`, {body: {...body, version: version - 1}});
  await call(412, 'PUT', `${v1}/scene`, {body, ...stale});
  await call(412, 'DELETE', `${v1}/scene/objects`, stale);
  await call(200, 'DELETE', `${v1}/scene/objects`);
});

test('speed is changed, faults are injected and removed', async () => {
  for (const body of [{speed: 0}, {speed: 1001}, {}]) await call(422, 'PUT', `${v1}/sim/speed`, {body});
  const fault = await call(201, 'POST', `${v1}/sim/faults`, {body: example(`${v1}/sim/faults`, 'POST', 'slow')});
  const {faults} = await call(200, 'GET', `${v1}/sim/faults`);
  assert.equal(faults.find(({id}) => id === fault.id).kind, 'slow');
  await call(204, 'DELETE', `${v1}/sim/faults/{id}`, {args: fault});
  await call(404, 'DELETE', `${v1}/sim/faults/{id}`, {args: fault});
  await call(404, 'DELETE', `${v1}/sim/faults/{id}`, {args: {id: 'first'}});
  for (const body of [{arm: 'nobody', kind: 'stall'}, {arm: 'left', kind: 'hiccup'}, {arm: 'left', kind: 'slow'},
                      {arm: 'left', kind: 'slow', value: 2}]) {
    await call(422, 'POST', `${v1}/sim/faults`, {body});
  }
  for (const body of [{arm: 'left', kind: 'slow'}, {arm: 'left', kind: 'stall', value: 1}, {arm: 'left', kind: 'fault', value: 1},
                      {arm: 'left', kind: 'fault', for_s: 1}, {arm: 'left', kind: 'drift', value: 11}]) {
    await call(422, 'POST', `${v1}/sim/faults`, {body});
    assert.ok(!contract.fitsBody(`${v1}/sim/faults`, 'POST', body), JSON.stringify(body));
  }
  await call(201, 'POST', `${v1}/sim/faults`, {body: {arm: 'right', kind: 'stall', at_s: 0, for_s: 0.1}});
  await call(200, 'PUT', `${v1}/sim/speed`, {body: example(`${v1}/sim/speed`, 'PUT', 'double')});
});

// Calls the server directly, because the proxy answers most of these requests itself.
const straight = (status, method, template, how) => call(status, method, template, {...how, direct: true});
test('every operation refuses malformed and foreign requests', async () => {
  const args = {id: 'x', name: 'left'};
  const large = 'x'.repeat(20 * 1024);
  for (const {path: template, method, operation} of contract.operations()) {
    const listed = operation.responses;
    await straight(400, method, template, {args, query: '?a=%zz'});
    await straight(431, method, template, {args, headers: {'X-Large': large}});
    await straight(414, method, template, {args, query: `?${large}`});
    await straight(417, method, template, {args, headers: {Expect: 'the unexpected'}});
    await straight(413, method, template, {args, headers: {'Content-Length': 9 << 20}, bodyless: true});
    const socket = template === `${v1}/ws`;
    if (method !== 'GET' || socket) await straight(403, method, template, {args, headers: {Origin: 'http://elsewhere.example', ...(socket ? handshake() : {})}});
    if (403 in listed) await straight(403, method, template, {args, headers: {Host: 'elsewhere.example', ...(socket ? handshake() : {})}});
    if (template !== '/') await straight(400, method, template, {args, query: '?bogus=1'});
    if (426 in listed) await straight(426, method, template);
    if (operation.requestBody) {
      await straight(415, method, template, {args, raw: '{}', headers: {'Content-Type': 'text/plain'}});
      await straight(422, method, template, {args, body: {bogus: 1}});
      assert.ok(!contract.fitsBody(template, method, {bogus: 1}), `${template} takes unknown fields`);
      await straight(400, method, template, {args, raw: '{"a": '});
    }
  }
  await call(202, 'POST', `${v1}/resume`);  // a faulty stop stops
});

// Every operation with a role answers 401 without a token.
test('a server with tokens requires them', async () => {
  const tokens = path.join(folder, 'tokens');
  const made = (name, role) => execFileSync(binary, ['token', 'add', '--tokens', tokens, '--name', name, '--role', role],
                                            {encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore']}).trim();
  const token = made('a', 'viewer');
  const admin = {Authorization: `Bearer ${made('b', 'admin')}`};
  const closed = await startServer(binary, ['--cell', path.join(folder, 'cell.json'), '--tokens', tokens,
                                            '--data', path.join(folder, 'data')]);
  const asked = async (method, template, headers = {}, body = undefined) => {
    const answer = await ask(closed.port, method, template.replace(/\{\w+\}/g, 'x'), {headers, body});
    contract.answer(template, method, answer);
    return answer;
  };
  try {
    for (const {path: template, method, operation} of contract.operations()) {
      const upgrade = template === `${v1}/ws` ? handshake() : {};
      assert.equal('x-role' in operation, operation.security === undefined, template);
      if (operation.security) continue;
      assert.equal((await asked(method, template, upgrade)).status, 401, template);
      if (operation['x-role'] === 'viewer') continue;
      assert.equal((await asked(method, template, {...upgrade, Authorization: `Bearer ${token}`})).status, 403, template);
    }
    assert.equal((await asked('GET', '/')).status, 303);
    const wrong = JSON.stringify({token: `${token}x`});
    assert.equal((await asked('POST', `${v1}/session`, json, wrong)).status, 401);
    const entered = await asked('POST', `${v1}/session`, json, JSON.stringify({token}));
    assert.equal(entered.status, 200);
    const cookie = entered.headers['set-cookie'][0].split(';')[0];
    const session = JSON.parse((await asked('GET', `${v1}/session`, {Cookie: cookie})).text);
    assert.deepEqual(session, {auth_required: true, name: 'a', role: 'viewer'});
    assert.equal((await asked('DELETE', `${v1}/session`, {Cookie: cookie})).status, 204);
    const {kept, recordings: [running]} = JSON.parse((await asked('GET', `${v1}/recordings`, {Authorization: `Bearer ${token}`})).text);
    assert.deepEqual([kept, running.name, running.running], [true, 'data', true]);
    for (const {name} of running.files) {
      const file = await ask(closed.port, 'GET', `${v1}/recordings/${running.name}/${name}`, {headers: {Authorization: `Bearer ${token}`}});
      contract.answer(`${v1}/recordings/{name}/{file}`, 'GET', file);
      assert.equal(file.status, 200, name);
    }
    await until('the audit trail', async () => {
      const audit = await asked('GET', `${v1}/audit-log`, admin);
      assert.equal(audit.status, 200, audit.text);
      const {entries} = JSON.parse(audit.text);
      return entries.some(({who, method, path: done, status}) => who === 'a' && method === 'POST' && done === `${v1}/stop` && status === 403);
    });
  } finally {
    closed.end();
  }
});

test('rate-limited clients get Retry-After and may still stop arms', async () => {
  const strict = await startServer(binary, ['--cell', path.join(folder, 'cell.json'), '--requests-per-second', '0.01']);
  const asked = async (method, template, more = {}) => {
    const answer = await ask(strict.port, method, template.replace(/\{\w+\}/g, 'x'), more);
    contract.answer(template, method, answer);
    return answer;
  };
  try {
    assert.equal((await asked('GET', '/metrics')).status, 200);
    for (const {path: template, method, operation} of contract.operations()) {
      const headers = template === `${v1}/ws` ? handshake() : {};
      if (!(429 in operation.responses)) {
        for (let i = 0; i < 4; ++i) assert.notEqual((await asked(method, template)).status, 429, template);
        continue;
      }
      const refused = await asked(method, template, {headers});
      assert.equal(refused.status, 429, template);
      assert.ok(Number(refused.headers['retry-after']) > 1);
    }
    assert.equal((await asked('POST', `${v1}/stop`)).status, 202);
  } finally {
    strict.end();
  }
});

test('each path serves exactly the listed methods, and HEAD with GET', async () => {
  for (const [template, methods] of Object.entries(contract.document.paths)) {
    const target = template.replace(/\{\w+\}/g, 'x');
    const refused = await ask(server.port, 'LOCK', target);
    assert.equal(refused.status, 405, `LOCK ${target}`);
    contract.schema('Problem', JSON.parse(refused.text));
    const allowed = refused.headers.allow.split(', ').sort();
    const listed = ['OPTIONS', ...Object.keys(methods).flatMap((method) => (method === 'get' ? ['GET', 'HEAD'] : [method.toUpperCase()]))].sort();
    const options = await ask(server.port, 'OPTIONS', target);
    assert.deepEqual([options.status, options.headers.allow.split(', ').sort()], [204, listed], `OPTIONS ${target}`);
    assert.deepEqual(allowed, listed, template);
    const stream = template === `${v1}/events` || template === `${v1}/ws`;
    if (!methods.get || stream) continue;
    const [head, get] = [await ask(server.port, 'HEAD', target), await ask(server.port, 'GET', target)];
    assert.deepEqual([head.status, head.headers['content-type'], head.text], [get.status, get.headers['content-type'], ''], target);
  }
  const nothing = await ask(server.port, 'GET', `${v1}/nothing`);
  assert.equal(nothing.status, 404);
  contract.schema('Problem', JSON.parse(nothing.text));
});

test('a server without a built dashboard answers 404', async () => {
  fs.mkdirSync(path.join(folder, 'nothing'));
  const bare = await startServer(binary, ['--cell', path.join(folder, 'cell.json'), '--web', path.join(folder, 'nothing')]);
  try {
    const answer = await ask(bare.port, 'GET', '/');
    assert.equal(answer.status, 404);
    contract.answer('/', 'GET', answer);
  } finally {
    bare.end();
  }
});

// The time step is longer than both motions, so only their ends are compared and both are admitted.
test('monitor stops are published', async () => {
  const cell = JSON.parse(fs.readFileSync(path.join(folder, 'cell.json'), 'utf8'));
  Object.assign(cell, {clearance_m: 0.1, scheduling: {...cell.scheduling, policy: 'timed_discrete'},
                       checking: {...cell.checking, time_step_s: 10},
                       monitor: {...cell.monitor, stop_clearance_m: 0.1}});
  fs.writeFileSync(path.join(folder, 'blind.json'), JSON.stringify(cell));
  const blind = await startServer(binary, ['--cell', path.join(folder, 'blind.json'), '--speed', '5']);
  const told = [];
  const stream = await openWebSocket(blind.port, `${v1}/ws`, (message) => { contract.message(message); told.push(message); });
  try {
    const {id, ...there} = example(`${v1}/jobs`, 'POST', 'reach');
    const [from, to] = there.trajectory.points;
    there.trajectory.points = [from, to, {...from, time_from_start: {sec: 2 * to.time_from_start.sec, nanosec: 0}}];
    for (const arm of ['left_', 'right_']) {
      const body = JSON.stringify(there).replaceAll('left_', arm);
      const answer = await ask(blind.port, 'POST', `${v1}/jobs`, {body, headers: json});
      contract.answer(`${v1}/jobs`, 'POST', answer);
      assert.equal(answer.status, 202, answer.text);
    }
    const {data} = await until('the monitor', () => told.find((message) => message.type === 'monitor'));
    assert.equal(data.kind, 'approach');
    assert.equal(data.limit_m, 0.1);
    assert.match(data.text, /may come closer than 0.1000 m unless an arm stops/);
    assert.ok(data.stopped.length > 0 && data.stopped.every((arm) => data.arms.includes(arm)), data.text);
  } finally {
    stream.close();
    blind.end();
  }
});

// The job is so slow that the arm is still braking when the next request arrives. That request needs a kept-alive
// connection, because the server accepts no new connections.
test('a server that shuts down accepts no job', async () => {
  const ending = await startServer(binary, ['--cell', path.join(folder, 'cell.json'), '--speed', '0.02']);
  const agent = new http.Agent({keepAlive: true, maxSockets: 1});
  const submit = (id) => ask(ending.port, 'POST', `${v1}/jobs`,
                             {body: JSON.stringify({...example(`${v1}/jobs`, 'POST', 'reach'), id}), headers: json, agent});
  try {
    assert.equal((await submit('first')).status, 202);
    await until('the motion', async () => {
      const {text} = await ask(ending.port, 'GET', `${v1}/arms/left`, {agent});
      const arm = JSON.parse(text);
      return arm.state === 'moving' && arm.progress > 0.005;
    });
    ending.end();
    const refused = await until('the refusal', async () => {
      const answer = await submit('second');
      contract.answer(`${v1}/jobs`, 'POST', answer);
      return answer.status === 503 && answer;
    });
    assert.equal(JSON.parse(refused.text).type, 'urn:armloom:problem:server-ends');
  } finally {
    agent.destroy();
    ending.end();
  }
});

test('every listed status was seen', () => {
  const lacking = [];
  let answers = 0;
  for (const {path: template, method, operation} of contract.operations()) {
    const seen = contract.seen.get(`${method} ${template}`) ?? new Set();
    const statuses = [...seen].sort();
    answers += statuses.length;
    console.log(`${method.padEnd(6)} ${template}: ${statuses.join(' ')}`);
    for (const status of Object.keys(operation.responses)) {
      if (!['503', '507'].includes(status) && !seen.has(status)) lacking.push(`${method} ${template}: ${status}`);
    }
  }
  const messages = [...contract.messages].map(([type, count]) => `${type} ${count}`).join(', ');
  console.log(`${contract.operations().length} operations, ${answers} kinds of answer; messages: ${messages}`);
  assert.deepEqual(lacking, [], 'listed, but never seen');
  assert.ok(contract.seen.get(`POST ${v1}/jobs`).has('503'), 'no 503');
  for (const type of ['snapshot', 'job', 'arm', 'queue', 'scene', 'io', 'state', 'monitor', 'alert']) assert.ok(contract.messages.has(type), `no ${type} message`);
});
