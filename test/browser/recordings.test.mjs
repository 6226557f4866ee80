// Recordings in the dashboard. They are opened from the server or from files, and scrubbed. Past
// times have data from before the page was loaded. The MCAP export is read back by the MCAP reader
// and by the page.
//
//   node --test test/browser/recordings.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, beforeEach, test } from 'node:test';
import {
  address_like, arm_now, ask, counts, drop_files, eventually, finished, go_to, job_through, kBinary, kRoot, label_of, looks_different, path_for, reads, send_through, view_picture, web_require, with_dashboard,
} from './harness.mjs';

const kLeastMoved_px = 800;

const kSwing = [0.7, -1.2, 0, -2.6, 0, 1.6, 0.785];
const folder = mkdtempSync(join(tmpdir(), 'armloom-recordings-'));
const data = join(folder, 'data');
let page;
const { server, chromium } = with_dashboard('config/two_pandas.json', 'coordinated', { acceptDownloads: true, more: ['--data', data, '--record'] }, (opened) => { ({ page } = opened); });
after(() => rmSync(folder, { recursive: true, force: true }));

// Closes a recording that a failed test left open.
beforeEach(async () => {
  if (await page.locator('[data-test=link].recording').count() === 0) return;
  await go_to(page, '#/recordings');
  await page.locator('[data-test=recording-close]').click();
  await page.locator('[data-test=link].open').waitFor();
}, { timeout: 60_000 });

/** Simulates two jobs and records them into the folder `run`. */
function record() {
  const q = [0, -1.2, 0, -2.6, 0, 1.6, 0.785];
  const names = ['left', 'right'].map((arm) => Array.from({ length: 7 }, (_, i) => `${arm}_panda_joint${i + 1}`));
  const jobs = names.map((joints, i) => ({ at: i, job: job_through(`recorded-${i}`, joints, [q, q.map((angle, k) => angle + (k === 0 ? 0.7 : 0)), q], 2) }));
  writeFileSync(join(folder, 'jobs.json'), JSON.stringify(jobs));
  execFileSync(kBinary, ['simulate', '--cell', 'config/two_pandas.json', '--jobs', join(folder, 'jobs.json'), '--out', join(folder, 'run')], { cwd: kRoot });
}

test('A recording opens from files, can be scrubbed, and closes', { timeout: 400_000 }, async () => {
  record();
  await page.locator('[data-test=more-pages]').click();
  await page.locator('[data-test=go-recordings]').click();
  const files = page.locator('[data-test=recording-files]');
  await drop_files(page, [join(folder, 'run/events.jsonl')], 'nav');
  await page.locator('[data-test=opened]', { hasText: 'no positions' }).waitFor();
  await page.locator('[data-test=recording-close]').click();
  await drop_files(page, [join(folder, 'jobs.json'), join(folder, 'run/states_idle.csv')], 'nav');
  await reads(page.locator('[data-test=recording-fault]'), /neither a states\.csv nor an events\.jsonl/);
  await files.setInputFiles(['states.csv', 'events.jsonl'].map((name) => join(folder, 'run', name)));
  await page.locator('[data-test=opened]').waitFor();
  await page.locator('[data-test=recording]').waitFor();
  // At the beginning of the recording no job has ended.
  await page.locator('[data-test=count-finished]', { hasText: /^0$/ }).waitFor();
  await reads(page.locator('[data-test=arm-right] [data-test=arm-state]'), /^○\s+idle$/);
  await page.locator('[data-test=lane-text-left]', { hasText: 'nothing is planned' }).waitFor({ state: 'attached' });
  const before = await view_picture(page);
  const scrub = page.locator('[data-test=scrub]');
  await scrub.fill('2');
  await page.locator('[data-test=instant]', { hasText: '0:00:02' }).waitFor();
  await looks_different(page, before, kLeastMoved_px);
  // All views show this time: card, label and lists.
  await page.locator('[data-test=list-running] [data-test="job-recorded-1"]').waitFor();
  await page.locator('[data-test=arm-right] [data-test=arm-state]', { hasText: 'moving' }).waitFor();
  await reads(label_of(page, 'right'), /moving/);
  await reads(page.locator('[data-test=state-at]'), /0:00:02/);
  await page.screenshot(path_for('recording-dark'));
  await page.locator('[data-test=play]').click();
  await page.locator('[data-test=instant]', { hasText: '0:00:03' }).waitFor();
  await page.locator('[data-test=list-finished] [data-test="job-recorded-1"]').waitFor();
  await page.locator('[data-test=recording-close]').click();
  await page.locator('[data-test=link].open').waitFor();
  await page.locator('[data-test="job-recorded-1"]').waitFor({ state: 'detached' });
  await page.locator('[data-test=recording]').waitFor({ state: 'detached' });
});

test('After a reload, past times have states, events and poses', { timeout: 400_000 }, async () => {
  const { names, q } = await arm_now(page, 'left');
  const job = job_through('before', names, [q, q.map((angle, i) => (i === 0 ? angle + 0.3 : angle)), q], 3);
  assert.equal((await ask(page, 'POST', '/jobs', job)).status, 202);
  await page.locator('[data-test=list-finished] [data-test="job-before"]').waitFor();
  await ask(page, 'POST', '/stop');
  await ask(page, 'POST', '/resume');
  const { started_s, ended_s } = await page.evaluate(() => window.armloom.jobs().find(({ id }) => id === 'before'));
  await go_to(page, `#/arm/left?t=${((started_s + ended_s) / 2).toFixed(2)}`);
  await page.reload();
  await page.locator('[data-test=instant]').waitFor();
  await page.locator('.notice', { hasText: 'stopped' }).first().waitFor();
  await page.locator('[data-test=list-running] [data-test="job-before"]').waitFor();
  await page.locator('[data-test=arm-left] [data-test=arm-state]', { hasText: 'moving' }).waitFor();
  await page.waitForFunction(() => window.armloom?.is_drawn());
  const then = await view_picture(page);
  await page.screenshot(path_for('reload-looks-back'));
  await eventually(async () => assert.ok(Number(await page.locator('[data-test=scrub]').getAttribute('min')) < started_s, 'what is looked back at begins with what the server kept'));
  // The page shows no pose for a time without data.
  await go_to(page, `#/arm/left?t=${(ended_s + 3600).toFixed(2)}`);
  await page.locator('[data-test=unheard]').waitFor();
  await no_arm_is_labelled();
  await page.locator('[data-test=unheard-now]').click();
  await page.locator('[data-test=arm-left] [data-test=arm-state]', { hasText: 'idle' }).waitFor();
  await looks_different(page, then, kLeastMoved_px);
});

const no_arm_is_labelled = () => counts(page.locator('.arm-label:visible'), 0, 'a label of an arm that is not drawn');

/** Moves the scrub bar to the step nearest to `t_s`. */
const scrub_to = (t_s) => page.locator('[data-test=scrub]').evaluate((bar, t_s) => {
  bar.value = String(t_s);
  bar.dispatchEvent(new Event('input', { bubbles: true }));
}, t_s);

/**
 * Returns the list entry of a recording by its folder name, or the entry of the recording being
 * written.
 */
const kept = (name) => page.locator(name === 'running' ? '[data-test^=recording-]:has-text("Being written")' : `[data-test="recording-${name}"]`);

test('Recordings of previous and present sessions open from the server list', { timeout: 500_000 }, async () => {
  await go_to(page, '#/');
  await send_through(page, 'left', 'kept-long-ago', [kSwing, null], 2);
  await finished(page, 'kept-long-ago');
  const { started_s } = await page.evaluate(() => window.armloom.jobs().find(({ id }) => id === 'kept-long-ago'));
  await server.end();
  await page.locator('[data-test=lost]').waitFor();
  await server.start();
  await page.locator('[data-test=link].open').waitFor();
  await page.locator('[data-test="job-kept-long-ago"]').waitFor({ state: 'detached' });
  await go_to(page, '#/recordings');
  await kept('data').getByText('positions and events').waitFor();
  await kept('running').waitFor();
  await page.screenshot(path_for('recordings-of-the-server-dark'));
  await kept('data').locator('[data-test=open-recording]').click();
  await page.locator('[data-test=opened]').waitFor();
  const still = await view_picture(page);
  await scrub_to(started_s + 2);
  await page.locator('[data-test=list-running] [data-test="job-kept-long-ago"]').waitFor();
  await looks_different(page, still, kLeastMoved_px);
  await page.screenshot(path_for('recording-of-the-server-dark'));
  await page.locator('[data-test=recording-close]').click();
  await page.locator('[data-test=link].open').waitFor();

  await send_through(page, 'right', 'kept-just-now', [null], 1);
  await finished(page, 'kept-just-now');
  await page.locator('[data-test=recordings-again]').click();
  await kept('running').locator('[data-test=open-recording]').click();
  await page.locator('[data-test=opened]').waitFor();
  await page.locator('[data-test=scrub]').press('End');
  await finished(page, 'kept-just-now');
  await page.locator('[data-test=recording-close]').click();
  await page.locator('[data-test=link].open').waitFor();
});

test('Files of a recording are downloaded unchanged', { timeout: 300_000 }, async () => {
  await kept('data').locator('summary').click();
  const [download] = await Promise.all([page.waitForEvent('download'), kept('data').getByRole('link', { name: 'events.jsonl' }).click()]);
  assert.equal(download.suggestedFilename(), 'data-events.jsonl');
  assert.ok(readFileSync(await download.path()).equals(readFileSync(join(data, 'events.jsonl'))));
});

test('A recording without positions can be scrubbed by its events', { timeout: 300_000 }, async () => {
  rmSync(join(data, 'states.csv'));
  await page.locator('[data-test=recordings-again]').click();
  await kept('data').getByText('events only').waitFor();
  await kept('data').locator('[data-test=open-recording]').click();
  await page.locator('[data-test=opened]').waitFor();
  await page.locator('[data-test=without-positions]').waitFor();
  const { started_s, ended_s } = await page.evaluate(() => window.armloom.jobs().find(({ id }) => id === 'kept-long-ago'));
  await scrub_to((started_s + ended_s) / 2);
  await page.locator('[data-test=list-running] [data-test="job-kept-long-ago"]').waitFor();
  await no_arm_is_labelled();
  await page.screenshot(path_for('recording-without-positions-dark'));
  await page.locator('[data-test=recording-close]').click();
  await page.locator('[data-test=link].open').waitFor();
  await page.locator('[data-test=without-positions]').waitFor({ state: 'detached' });
});

test('Reading a large recording shows progress and can be canceled', { timeout: 300_000 }, async () => {
  cpSync(join(folder, 'run'), join(data, '2026-01-02T03-04-05Z'), { recursive: true });
  const [head, ...rows] = readFileSync(join(folder, 'run/states.csv'), 'utf8').trimEnd().split('\n');
  const times = Array.from({ length: 20 }, (_, turn) => rows.map((row) => row.replace(/^[^,]*/, (t_s) => (Number(t_s) + 100 * turn).toFixed(3))));
  writeFileSync(join(data, '2026-01-02T03-04-05Z/states.csv'), [head, ...times.flat(), ''].join('\n'));
  await page.locator('[data-test=recordings-again]').click();
  const open = kept('2026-01-02T03-04-05Z').locator('[data-test=open-recording]');
  await reads(open, /^Open, \d+ MB$/);
  const session = await page.context().newCDPSession(page);
  const slowly = (downloadThroughput) => session.send('Network.emulateNetworkConditions', { offline: false, latency: 0, downloadThroughput, uploadThroughput: -1 });
  await slowly(1_000_000);
  await open.click();
  await page.locator('[data-test=reading]', { hasText: /[1-9][\d.]* [kM]B of \d+ MB/ }).waitFor();
  await page.screenshot(path_for('recording-is-read-dark'));
  await page.locator('[data-test=stop-reading]').click();
  await page.locator('[data-test=reading]').waitFor({ state: 'detached' });
  await slowly(-1);
  assert.equal(await page.locator('[data-test=opened]').count(), 0, 'what was given up is not opened');
  await open.click();
  await page.locator('[data-test=opened]').waitFor();
  await page.locator('[data-test=recording-close]').click();
  await page.locator('[data-test=link].open').waitFor();
});

test('A camera in an address shows the same in another tab, also next to a pane', { timeout: 400_000 }, async () => {
  await page.setViewportSize({ width: 1024, height: 768 });
  await go_to(page, '#/arm/right');
  await page.locator('[data-test=page-arm]').waitFor();
  // In a window of this width the legend is behind a button.
  const legend = page.locator('.timeline .legend');
  await legend.locator('summary').click();
  await legend.getByText('stopped').waitFor();
  await page.screenshot(path_for('legend-1024'));
  await legend.locator('summary').click();
  await page.locator('[data-test=camera-left]').click();
  await page.locator('[data-test=camera-nearer]').click();
  const other = await chromium.context.newPage();
  await other.setViewportSize({ width: 1024, height: 768 });
  await other.goto(await address_like(page, /camera=/));
  await other.waitForFunction(() => window.armloom?.is_drawn());
  await other.locator('[data-test=page-arm]').waitFor();
  await eventually(async () => {
    const places = [];
    for (const tab of [page, other]) {
      await tab.bringToFront();
      await tab.evaluate(() => window.armloom.drawn());
      places.push(await tab.evaluate(() => window.armloom.where_is('table')));
    }
    assert.ok(Math.hypot(places[0].x - places[1].x, places[0].y - places[1].y) < 3, JSON.stringify(places));
  });
  await other.screenshot(path_for('camera-other-tab'));
  await other.close();
  await page.setViewportSize({ width: 1280, height: 720 });
});

test('The MCAP export is readable by the MCAP reader and by the page', { timeout: 500_000 }, async () => {
  await go_to(page, '#/recordings');
  const { names, q } = await arm_now(page, 'left');
  const job = job_through('exported', names, [q, q.map((angle, i) => (i === 0 ? angle + 0.6 : angle)), q], 4);
  assert.equal((await ask(page, 'POST', '/jobs', job)).status, 202);
  await page.locator('[data-test=list-finished] [data-test="job-exported"]').waitFor();
  const [download] = await Promise.all([page.waitForEvent('download', { timeout: 90_000 }), page.locator('[data-test=export-mcap]').click()]);
  assert.match(download.suggestedFilename(), /two_pandas\.mcap/);
  const { McapStreamReader } = web_require('@mcap/core');
  const reader = new McapStreamReader();
  reader.append(readFileSync(await download.path()));
  const schemas = new Map();
  const topics = new Map();
  const messages = new Map();
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    if (record.type === 'Schema') schemas.set(record.id, record);
    if (record.type === 'Channel') topics.set(record.id, record);
    if (record.type !== 'Message') continue;
    const { topic } = topics.get(record.channelId);
    messages.set(topic, [...messages.get(topic) ?? [], JSON.parse(Buffer.from(record.data).toString())]);
  }
  assert.ok(reader.done(), 'the file has its end');
  assert.deepEqual([...topics.values()].map(({ topic, schemaId }) => [topic, schemas.get(schemaId).name, schemas.get(schemaId).encoding]).sort(), [
    ['/armloom', 'armloom.Event', 'jsonschema'], ['/events', 'foxglove.Log', 'jsonschema'], ['/jobs', 'armloom.Job', 'jsonschema'], ['/joint_states', 'foxglove.JointStates', 'jsonschema'],
    ['/scene', 'foxglove.SceneUpdate', 'jsonschema'], ['/tf', 'foxglove.FrameTransforms', 'jsonschema'],
  ]);
  const Ajv = web_require('ajv').default;
  for (const { topic, schemaId } of topics.values()) {
    const fits = new Ajv({ strict: false }).compile(JSON.parse(Buffer.from(schemas.get(schemaId).data).toString()));
    for (const message of messages.get(topic) ?? []) assert.ok(fits(message), `${topic}: ${JSON.stringify(fits.errors)}`);
  }
  const joints = messages.get('/joint_states');
  const swing = joints.map(({ joints }) => joints.find(({ name }) => name === 'left_panda_joint1').position);
  assert.ok(Math.max(...swing) - Math.min(...swing) > 0.35, 'the arm moves in it');
  assert.equal(messages.get('/tf').length, joints.length);
  const hand = messages.get('/tf').map(({ transforms }) => transforms.find(({ child_frame_id }) => child_frame_id === 'left_panda_hand').translation);
  assert.ok(Math.max(...hand.map(({ y }) => y)) - Math.min(...hand.map(({ y }) => y)) > 0.1, 'and its hand with it');
  assert.equal(messages.get('/scene')[0].entities[0].id, 'table');
  assert.ok(messages.get('/jobs').some(({ id, state }) => id === 'exported' && state === 'succeeded'));
  // The page can open the exported file as a recording.
  const file = join(folder, 'taken.mcap');
  await download.saveAs(file);
  await drop_files(page, [file], 'nav');
  await page.locator('[data-test=opened]', { hasText: 'taken.mcap' }).waitFor();
  await page.locator('[data-test=recording]').waitFor();
  const scrub = page.locator('[data-test=scrub]');
  const last_s = Number(await scrub.getAttribute('max'));
  await scrub.press('End');
  await page.locator('[data-test=list-finished] [data-test="job-exported"]').waitFor();
  assert.ok((await page.evaluate(() => window.armloom.jobs().find(({ id }) => id === 'exported'))).ended_s <= last_s + 1);
  await page.locator('[data-test=recording-close]').click();
  await page.locator('[data-test=link].open').waitFor();
});

test('The console has no errors', () => {
  assert.deepEqual(chromium.errors.filter((text) => !/WebSocket|ERR_CONNECTION_REFUSED/.test(text)), []);
});
