// Arms in processes of their own: before their controllers run, and after a controller was killed.
//
//   node --test test/browser/remote.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { ask, counts, go_to, kBinary, kRoot, label_of, path_for, reads, send_through, with_dashboard } from './harness.mjs';

const folder = mkdtempSync(join(tmpdir(), 'armloom-remote-'));
const kCell = join(folder, 'cell.json');
writeFileSync(kCell, readFileSync(join(kRoot, 'config/two_pandas_remote.json'), 'utf8')
  .replaceAll('"feedback_timeout_s": 0.2', '"feedback_timeout_s": 10')  // a busy machine must not lose a link
  .replaceAll('unix:/tmp/armloom-', `unix:${folder}/`).replaceAll('"../models/', `"${kRoot}/models/`));
const robots = new Map();
const start = (name) => robots.set(name, spawn(kBinary, ['arm', '--cell', kCell, '--robot', name, '--listen', `unix:${folder}/${name}.sock`], { stdio: 'ignore' }));

let page;
with_dashboard(kCell, 'certified', {}, (opened) => { ({ page } = opened); });
after(() => {
  for (const robot of robots.values()) robot.kill('SIGKILL');
  rmSync(folder, { recursive: true, force: true });
});

const card = (arm) => page.locator(`[data-test=arm-${arm}]`);
const shows = (arm, state) => card(arm).locator('[data-test=arm-state]', { hasText: state }).waitFor();
const need = (arm) => page.locator(`[data-test=need-${arm}]`);

test('An arm without a controller is shown as connecting', { timeout: 300_000 }, async () => {
  await shows('left', 'connecting');
  await reads(card('left').locator('[data-test=arm-note]'), /^Waits for its controller; position not measured yet \(no answer from unix:.*left\.sock/);
  await reads(page.locator('[data-test=some-stopped]'), /left waits for its controller, right waits for its controller/);
  await page.screenshot(path_for('connecting-dark'));
  await go_to(page, '#/recovery');
  await reads(need('left'), /Start its controller\. The arm then becomes ready by itself/);
  assert.equal(await page.locator('[data-test=resume-left]').count(), 0);
  await page.screenshot(path_for('connecting-recovery-dark'));
  await go_to(page, '#/');
  for (const name of ['left', 'right']) start(name);
  for (const name of ['left', 'right']) await shows(name, 'idle');
  await counts(page.locator('[data-test=arm-note]'), 0);
  await counts(page.locator('[data-test=some-stopped]'), 0);
});

test('An arm whose controller was killed does not look as if it moves, and is resumed when the controller is back', { timeout: 300_000 }, async () => {
  await send_through(page, 'left', 'swing', [[0.5, -0.7, 0, -1.8, 0, 2.6, 0]], 30);
  await shows('left', 'moving');
  robots.get('left').kill('SIGKILL');
  await shows('left', 'link lost');
  await reads(card('left').locator('[data-test=arm-note]'), /^Link lost: last known position \(.*left\.sock/);
  await label_of(page, 'left').filter({ hasText: 'link lost' }).waitFor();
  await reads(page.locator('[data-test=some-stopped]'), /The link to left is lost/);
  await page.locator('[data-test="job-swing"] [data-test=figure]', { hasText: 'stopped' }).waitFor();
  await shows('right', 'idle');
  await page.screenshot(path_for('lost-dark'));
  await go_to(page, '#/recovery');
  await reads(need('left'), /link lost\s.*Link lost: last known position.*Start its controller; then resume the arm/s);
  for (let i = 0; i < 4; i++) await page.locator(`[data-test=check-${i}]`).click();
  for (const button of ['resume-left', 'resume-checked']) assert.ok(await page.locator(`[data-test=${button}]`).isDisabled(), button);
  await reads(page.locator('[data-test=checks-left]'), /^Start the controller first/);
  await page.screenshot(path_for('lost-recovery-dark'));
  start('left');
  await need('left').locator('[data-test=arm-state]', { hasText: 'stopped' }).waitFor();
  await page.locator('[data-test=resume-left]').click();
  await need('left').locator('[data-test=arm-state]', { hasText: 'idle' }).waitFor();
});

test('Drives that are off are shown', { timeout: 300_000 }, async () => {
  await go_to(page, '#/arm/right');
  await ask(page, 'POST', '/arms/right/stop?category=1');
  const notes = page.locator('[data-test=page-arm] [data-test=arm-note]');
  await reads(notes.first(), /^Stopped: operator$/);
  await reads(notes.last(), /^Drives off$/);
  await page.screenshot(path_for('drives-off-dark'));
});

test('Faults are not offered for remote controllers', { timeout: 300_000 }, async () => {
  await go_to(page, '#/settings');
  await reads(page.locator('[data-test=no-faults]'), /only simulated controllers take faults/);
  await counts(page.locator('[data-test=inject-fault]'), 0);
});
