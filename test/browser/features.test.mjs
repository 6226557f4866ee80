// Features of the dashboard: tool paths with authority, ghosts, distances, planned and measured
// joints, priorities, recovery after a stop, alerts, dragging objects, policies, replanning.
//
//   node --test test/browser/features.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { address_like, ask, counts, eventually, finished, go_to, kRoot, label_of, looks_different, path_for, reads, send_through, view_picture, with_dashboard } from './harness.mjs';

const kMiddle = [0, -0.7, 0, -1.8, 0, 2.6, 0];
const kLeastWay_px = 60;
const kLeastGhost_px = 800;
const kFirstView_kB = 250;

// Under the policy `certified` a conflicting job is blocked.
let page;
const { chromium } = with_dashboard('config/two_pandas.json', 'certified', {}, (opened) => { ({ page } = opened); });

const go = (hash) => go_to(page, hash);
const speed = (value) => ask(page, 'PUT', '/sim/speed', { speed: value });
const ended = (id) => finished(page, id);

const send = (...job) => send_through(page, ...job);

/**
 * Checks that a click on the button hides more than `least_px` pixels of the view, then shows them
 * again.
 */
async function puts_away(test, least_px, what) {
  const shown = await view_picture(page);
  await page.locator(`[data-test=${test}]`).click();
  await looks_different(page, shown, least_px, what);
  await page.locator(`[data-test=${test}]`).click();
}

test('3D view shows tool paths, ghosts of end positions, and closest pairs', { timeout: 400_000 }, async () => {
  await speed(0.02);  // slow, so that the compared pictures hardly differ by motion
  await send('left', 'ahead', [kMiddle, null], 6, { name: 'there and back' });
  await page.locator('[data-test=list-running] [data-test="job-ahead"]').waitFor();
  await page.waitForFunction(() => window.armloom.ahead() > 0);
  await page.locator('.distance-label:not([hidden])').first().waitFor();
  await reads(page.locator('.distance-label:not([hidden])').first(), /^[\d.]+ (mm|m)$/);
  await page.screenshot(path_for('ahead-dark'));
  await puts_away('show-paths', kLeastWay_px, 'pixels of the way ahead');
  await page.locator('[data-test=show-distances]').click();
  await counts(page.locator('.distance-label:not([hidden])'), 0);
  await page.locator('[data-test=show-distances]').click();
  await speed(20);
  await ended('ahead');
  await speed(0.02);
  await send('left', 'away', [kMiddle], 6);
  await page.locator('[data-test=list-running] [data-test="job-away"]').waitFor();
  await page.waitForFunction(() => window.armloom.ahead() > 0);
  await puts_away('show-ghosts', kLeastGhost_px, 'pixels of the ghost at its goal');
});

test('A blocked job names its blocker, links, distance, waiting time and expiry', { timeout: 300_000 }, async () => {
  await send('right', 'blocked', [kMiddle, null], 4, { backlog_timeout_s: 300 });
  const row = page.locator('[data-test=list-backlog] [data-test="job-blocked"]');
  await row.waitFor();
  await row.locator('[data-test=when]', { hasText: /blocked for [\d.]+ s.*expires in \d+ min/ }).waitFor();
  await row.locator('[data-test=reason]', { hasText: /right_panda_\w+ would (touch|come within).*left_panda_\w+, [\d.]+ s into its motion/ }).waitFor();
});

test('Priority buttons change the priority of a waiting job', { timeout: 300_000 }, async () => {
  const row = page.locator('[data-test="job-blocked"]');
  const priority = async () => (await ask(page, 'GET', '/jobs/blocked')).value.priority;
  await row.hover();
  await row.getByRole('button', { name: 'More urgent: blocked' }).click();
  await row.getByText('+1', { exact: true }).waitFor();
  await row.getByRole('button', { name: 'More urgent: blocked' }).click();
  await row.getByText('+2', { exact: true }).waitFor();
  assert.equal(await priority(), 2);
  for (const shown of ['+1', null]) {
    await row.getByRole('button', { name: 'Less urgent: blocked' }).click();
    await (shown ? row.getByText(shown, { exact: true }).waitFor() : row.locator('.priority').waitFor({ state: 'detached' }));
  }
  assert.equal(await priority(), 0);
  const moving = page.locator('[data-test=list-running] .job').first();
  assert.equal(await moving.locator('[data-test=urgency]').count(), 0, 'nobody goes before what moves');
});

test('Pointing at a diagram shows both arms as ghosts', { timeout: 300_000 }, async () => {
  await page.locator('[data-test="job-blocked"] [data-test=why]').click();
  const diagram = page.locator('[data-test=diagram]');
  await diagram.locator('canvas').first().waitFor();
  await page.locator('[data-test=instant-a_s]').waitFor();
  const before = await view_picture(page);
  const box = await diagram.boundingBox();
  await page.mouse.move(box.x + box.width * 0.55, box.y + box.height * 0.4);
  await looks_different(page, before, kLeastGhost_px, 'pixels of ghosts');
  await page.screenshot(path_for('diagram-pointed-dark'));
  await page.mouse.move(box.x + box.width + 400, box.y);
  await page.locator('[data-test=instant-b_s]').focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press('PageUp');
  await looks_different(page, before, kLeastGhost_px, 'pixels of ghosts');
  await page.getByRole('button', { name: 'Close', exact: true }).click();
  await speed(10);
  await ended('away');
});

test('Job page plots planned and measured joints', { timeout: 300_000 }, async () => {
  await ask(page, 'DELETE', '/jobs/blocked');  // if the job has started, it brakes first
  await ended('blocked');
  await speed(2);
  await send('right', 'measured', [kMiddle.map((angle, i) => (i === 0 ? 1 : angle)), null], 3);
  await go('#/job/measured');
  await page.locator('[data-test=page-job] h3', { hasText: /Planned/ }).waitFor();
  await ended('measured');
  await page.locator('[data-test=page-job] h3', { hasText: 'Planned and measured' }).waitFor();
  // The plot has 15 series: time, and each of seven joints as planned and as measured.
  await page.waitForFunction(() => document.querySelectorAll('[data-test=page-job] .u-series').length === 15);
  await page.screenshot(path_for('planned-dark'));
});

test('Recovery page states the cause of a stop and resumes the arms', { timeout: 400_000 }, async () => {
  await speed(1);
  await send('left', 'interrupted', [kMiddle.map((angle, i) => (i === 0 ? 0.5 : angle))], 20);
  await page.locator('[data-test=list-running] [data-test="job-interrupted"]').waitFor();
  await page.keyboard.press('F8');
  // The arm is shown as stopped everywhere, without a predicted end.
  await page.locator('[data-test=arm-left] [data-test=arm-state]', { hasText: 'stopped' }).waitFor();
  await label_of(page, 'left').filter({ hasText: 'stopped' }).waitFor();
  await page.locator('[data-test="job-interrupted"] [data-test=figure]', { hasText: 'stopped' }).waitFor();
  await page.waitForFunction(() => /waits for resume: left is stopped \(operator\), until it is resumed/.test(document.querySelector('[data-test=lane-text-left]').textContent));
  await eventually(async () => assert.ok((await page.evaluate(() => window.armloom.lanes())).every(({ marks }) => marks.every(({ expected, to_s }) => !expected || to_s === null || to_s === Infinity))));
  await page.screenshot(path_for('stopped-told-dark'));
  await go('#/arm/left');
  await page.locator('[data-test=resume-arm]').click();
  await page.locator('[data-test=cause]', { hasText: /stopped: left, right \(operator\)/ }).waitFor();
  await page.locator('[data-test=need-left]', { hasText: /continues from \d+ %/ }).waitFor();
  const resume = page.locator('[data-test=resume-checked]');
  const alone = page.locator('[data-test=resume-left]');
  for (let i = 0; i < 4; i++) {
    assert.ok(await resume.isDisabled() && await alone.isDisabled(), `with ${i} looked at`);
    await page.locator(`[data-test=check-${i}]`).check();
  }
  await page.locator('[data-test=resume-left]:enabled').waitFor();
  await page.screenshot(path_for('recovery-dark'));
  await resume.click();
  await page.locator('[data-test=stopped]').waitFor({ state: 'detached' });
  await speed(10);
  await ended('interrupted');
  await page.locator('[data-test=home-left]').click();
  await page.locator('[data-test=need-left]', { hasText: 'at home' }).waitFor();
  await speed(1);
});

test('Alerts are counted until acknowledged with a name', { timeout: 300_000 }, async () => {
  await page.locator('[data-test=open-alerts]').click();
  await page.locator('[data-test=person]').fill('  ');
  await page.locator('[data-test=unnamed]').waitFor();
  await counts(page.locator('[data-test=acknowledge]:enabled'), 0, 'nobody acknowledges nothing');
  await page.locator('[data-test=person]').fill('Ada <b>L</b>');
  await page.locator('[data-test=acknowledge]').first().click();
  await page.locator('[data-test=alerts]', { hasText: /Acknowledged by Ada <b>L<\/b>, \d{4}-\d\d-\d\d \d\d:\d\d:\d\d (UTC|[+−]\d\d:\d\d)/ }).waitFor();
  await page.screenshot(path_for('alerts-dark'));
  await ask(page, 'POST', '/arms/right/stop');
  await ask(page, 'POST', '/arms/right/resume');
  await page.locator('[data-test=alerts]', { hasText: 'stopped: right (operator)' }).waitFor();
  await page.locator('[data-test=acknowledge-all]').click();
  await page.locator('[data-test=open-alerts]').waitFor({ state: 'detached' });
});

test('A scene object can be dragged in the 3D view', { timeout: 300_000 }, async () => {
  await ask(page, 'PUT', '/scene/objects/crate', { box: [0.2, 0.2, 0.2], xyz: [0, 0.8, 0.3], rpy: [0, 0, 0] });
  await go('#/scene/crate');
  await page.locator('[data-test=move-object]').click();
  const where = () => page.evaluate(() => window.armloom.where_is('crate'));
  const drag = async (dx, dy) => {
    await page.evaluate(() => window.armloom.drawn());
    const view = await page.locator('.view canvas').boundingBox();
    const { x, y } = await where();
    await page.mouse.move(view.x + x, view.y + y);
    await page.mouse.down();
    await page.mouse.move(view.x + x + dx, view.y + y + dy, { steps: 6 });
  };
  await drag(60, 0);
  await page.mouse.up();
  await page.waitForFunction(() => window.armloom.objects().find(({ name }) => name === 'crate').xyz[0] > 0.05);
  const there = (await page.evaluate(() => window.armloom.objects())).find(({ name }) => name === 'crate');
  await address_like(page, /#\/scene\/crate/);
  await page.waitForFunction((x) => document.querySelector('[data-test=object-x]').value === x, String(there.xyz[0]));
  await page.screenshot(path_for('drag-object-dark'));
  // A canceled drag returns the object to its position.
  const stood = await where();
  const off_px = async () => Math.hypot((await where()).x - stood.x, (await where()).y - stood.y);
  await drag(60, 0);
  assert.ok(await off_px() > 20);
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await eventually(async () => assert.ok(await off_px() < 1));
  assert.deepEqual((await page.evaluate(() => window.armloom.objects())).find(({ name }) => name === 'crate').xyz, there.xyz);
  await ask(page, 'DELETE', '/scene/objects/crate');
  await go('#/');
});

test('Settings page changes the policy only while no job is admitted', { timeout: 300_000 }, async () => {
  const choose = (policy) => page.locator(`[data-test=policy-form] input[value=${policy}]`).check();
  await go('#/settings');
  await page.locator('[data-test=change-policy]:disabled').waitFor();
  await choose('coordinated');
  await page.locator('[data-test=change-policy]').click();
  await page.locator('.fact', { hasText: 'coordinated' }).waitFor({ state: 'attached' });
  await speed(1);
  await send('right', 'keeps-its-policy', [kMiddle.map((angle, i) => (i === 0 ? 0.3 : angle)), null], 4);
  await choose('certified');
  await page.locator('[data-test=no-change]', { hasText: 'Only possible while no job is admitted; admitted now: 1' }).waitFor();
  await page.locator('[data-test=change-policy]:disabled').waitFor();  // the button is disabled because the server would refuse the change
  await page.screenshot(path_for('policy-dark'));
  await speed(10);
  await go('#/');
  await ended('keeps-its-policy');
  assert.equal((await ask(page, 'PUT', '/policy', { policy: 'certified' })).status, 200);
  await page.locator('.fact', { hasText: 'certified' }).waitFor({ state: 'attached' });
});

test('Job page replans a running job', { timeout: 300_000 }, async () => {
  await speed(0.5);
  await send('right', 'another-way', [kMiddle.map((angle, i) => (i === 0 ? 0.3 : angle))], 6);
  await go('#/job/another-way');
  await page.waitForFunction(async () => (await (await fetch('/api/v1/jobs/another-way')).json()).state === 'running');
  await page.locator('[data-test=replan]').click();
  await page.getByRole('button', { name: 'Brake and replan' }).click();
  await page.waitForFunction(async () => {
    const { replan } = await (await fetch('/api/v1/jobs/another-way')).json();
    return replan?.done > 0;
  });
  await speed(10);
  await go('#/');
  await ended('another-way');
});

test('Faults of all clients are listed and can be removed; late reports are shown', { timeout: 300_000 }, async () => {
  await speed(1);
  await go('#/settings');
  await page.locator('[data-test=fault-kind]').selectOption('delay');
  await page.locator('[data-test=fault-value]').fill('0.07');  // later than half of the feedback timeout
  await page.locator('[data-test=inject-fault]').click();
  await page.locator('[data-test=arm-left] [data-test=arm-state]', { hasText: 'reports late' }).waitFor();
  const other = await ask(page, 'POST', '/sim/faults', { arm: 'right', kind: 'slow', value: 0.5 });
  assert.equal(other.status, 201);
  const listed = page.locator('[data-test=injected-faults] li');
  await listed.filter({ hasText: 'slow of right: 0.5' }).waitFor();
  await page.locator('[data-test=injected-faults]').scrollIntoViewIfNeeded();
  await page.screenshot(path_for('faults-dark'));
  await listed.filter({ hasText: 'delay of left: 0.07' }).getByRole('button', { name: 'Remove' }).click();
  await counts(listed, 1);
  assert.equal((await ask(page, 'DELETE', `/sim/faults/${other.value.id}`)).status, 204);
  await counts(listed, 0);
  await page.locator('[data-test=arm-left] [data-test=arm-state]', { hasNotText: 'reports late' }).waitFor();
  await go('#/');
});

test('No event is missed or doubled after a broken connection', { timeout: 300_000 }, async () => {
  const before = await page.evaluate(() => window.armloom.numbers());
  assert.deepEqual([before.missed, before.doubled], [0, 0]);
  await chromium.context.setOffline(true);
  await page.evaluate(() => window.armloom.break_connection());
  await page.locator('[data-test=lost]').waitFor();
  await chromium.context.setOffline(false);
  await page.getByRole('button', { name: 'Reconnect now' }).click().catch(() => {});  // the page may be connected already
  await page.locator('[data-test=link].open').waitFor();
  await speed(4);
  await send('right', 'after-the-break', [kMiddle.map((angle, i) => (i === 0 ? 0.3 : angle)), null], 4);
  await ended('after-the-break');
  const now = await page.evaluate(() => window.armloom.numbers());
  assert.deepEqual([now.missed, now.doubled], [0, 0]);
  assert.ok(now.last > before.last);
});

test('The first view is small without the parts loaded later', () => {
  const dist = process.env.ARMLOOM_WEB ?? join(kRoot, 'web/dist');
  const html = readFileSync(join(dist, 'index.html'), 'utf8');
  const named = [...html.matchAll(/(?:src|href)="\.\/(assets\/[^"]+)"/g)].map(([, file]) => file);
  const fonts = readdirSync(join(dist, 'assets')).filter((file) => file.endsWith('.woff2')).map((file) => `assets/${file}`);
  assert.ok(named.length >= 2 && fonts.length >= 2);
  const weight = [...named, ...fonts].reduce((sum, file) => sum + gzipSync(readFileSync(join(dist, file))).length, gzipSync(html).length);
  console.log(`The first view weighs ${(weight / 1000).toFixed(0)} kB compressed`);
  assert.ok(weight < kFirstView_kB * 1000, `${weight} bytes`);
});

test('The console has no errors', () => {
  // The job `blocked` may have ended just before it was canceled, which is answered with 409.
  assert.deepEqual(chromium.errors.filter((text) => !/ERR_INTERNET_DISCONNECTED|ERR_NETWORK|409 \(Conflict\).*\/jobs\/blocked$/.test(text)), []);
});
