// Jobs of previous server sessions on the dashboard.
//
//   node --test test/browser/history.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { ask, counts, finished, go_to, path_for, reads, resume, send_through, with_dashboard } from './harness.mjs';

const kMiddle = [0, -0.7, 0, -1.8, 0, 2.6, 0];
const data = mkdtempSync(join(tmpdir(), 'armloom-data-'));
let page;
let url;
const { server, chromium } = with_dashboard('config/two_pandas.json', 'coordinated', { more: ['--data', data, '--speed', '10'] }, (opened) => { ({ page, url } = opened); });
after(() => rmSync(data, { recursive: true, force: true }));

const go = (hash) => go_to(page, hash);
const ended = (id) => finished(page, id);

test('Jobs of a previous session are in the history and have pages', { timeout: 400_000 }, async () => {
  await send_through(page, 'left', 'long-ago', [kMiddle, null], 2, { name: 'picked long ago' });
  await ended('long-ago');
  const since = await page.evaluate(() => window.armloom.numbers().last);
  await go('#/history');
  const history = page.locator('[data-test=history]');
  await history.getByText('picked long ago').waitFor();

  await server.end();
  await page.locator('[data-test=lost]').waitFor();
  assert.equal(await server.start(), url);
  await page.locator('[data-test=link].open').waitFor();
  await page.getByText('The server was restarted').first().waitFor();
  // Checks the history without a reload of the page, then with a reload.
  for (const reload of [false, true]) {
    if (reload) await page.reload();
    await page.locator('[data-test=link].open').waitFor();
    await history.getByRole('link', { name: 'picked long ago' }).waitFor();
    await page.locator('[data-test=earlier-status]', { hasText: 'All jobs of the server are loaded' }).waitFor();
    await counts(page.locator('[data-test=list-finished] .job'), 0, 'they are none of this run');
    await reads(page.locator('[data-test=list-finished] .none'), /No job has ended in this server session/);
    await counts(page.locator('[data-test=loaded]'), 0, 'the number is of all');
  }
  // The table shows wall-clock times, because the clock of the cell has restarted.
  await reads(history.locator('tbody tr').first(), /^\s*(\d{4}-\d\d-\d\d )?\d\d:\d\d:\d\d\s/);
  await page.screenshot(path_for('history-former-dark'));
  await history.getByRole('link', { name: 'picked long ago' }).click();
  await page.locator('[data-test=page-job] [data-test=former]').waitFor();
  await reads(page.locator('[data-test=job-state]'), /^succeeded$/);
  await reads(page.locator('[data-test=states]'), /\d\d:\d\d:\d\d/);
  await page.screenshot(path_for('job-former-dark'));
  // The page of such a job can also be opened by its address.
  await page.reload();
  await page.locator('[data-test=page-job] h2', { hasText: 'picked long ago' }).waitFor();
  assert.ok(since > 0);
});

test('Jobs received as events are not requested again', { timeout: 400_000 }, async () => {
  const asked = [];
  page.on('request', (request) => { if (/\/jobs(\?|\/)/.test(request.url())) asked.push(request.url()); });
  await go('#/');
  if (await page.locator('[data-test=stopped], [data-test=some-stopped]').count() > 0) await resume(page);
  for (let i = 0; i < 3; i++) {
    await ask(page, 'POST', '/jobs', { id: `home-${i}`, arm: 'left', move_to: { named: i % 2 ? 'home' : 'ready' } });
    await ended(`home-${i}`);
  }
  assert.deepEqual(asked.filter((address) => /limit=/.test(address)), []);
});

test('The console has no errors', () => {
  assert.deepEqual(chromium.errors.filter((text) => !/WebSocket|ERR_CONNECTION_REFUSED/.test(text)), []);
});
