// While a past time is shown, every page shows that time, or says which of its parts show the
// present.
//
//   node --test test/browser/look_back.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ask, counts, eventually, finished, go_to, path_for, reads, resume, send_through, with_dashboard } from './harness.mjs';

const kMiddle = [0, -0.7, 0, -1.8, 0, 2.6, 0];

const dashboard = with_dashboard('config/two_pandas.json', 'coordinated');
/**
 * Cell times: before all jobs, while the first of two jobs ran, and while all arms were stopped.
 */
const at = {};

const now_s = async () => {
  const [hours, minutes, seconds] = (await dashboard.page.locator('[data-test=clock]').innerText()).split(':').map(Number);
  return 3600 * hours + 60 * minutes + seconds;
};
/** Waits until the cell's clock is later than `t_s`, and returns the clock. */
const clock_beyond = (t_s) => eventually(async () => {
  const s = await now_s();
  assert.ok(s > t_s, `${s} s, not yet beyond ${t_s} s`);
  return s;
}, 60_000);
const says_of_then = (pattern) => reads(dashboard.page.locator('[data-test=as-of]'), pattern);

test('Setup: jobs run, are stopped, and end', { timeout: 500_000 }, async () => {
  const { page } = dashboard;
  at.first = await clock_beyond(await now_s() + 1.5);
  await clock_beyond(at.first + 0.3);
  await ask(page, 'PUT', '/scene/objects/crate', { box: [0.2, 0.2, 0.2], xyz: [0, 1.2, 0.2], rpy: [0, 0, 0] });
  await send_through(page, 'left', 'there', [kMiddle, null], 6);
  await send_through(page, 'right', 'back', [kMiddle, null], 6);
  await page.locator('[data-test=list-running] [data-test="job-there"]').waitFor();
  const { started_s } = await page.evaluate(() => window.armloom.jobs().find(({ id }) => id === 'there'));
  at.running = await clock_beyond(started_s + 0.5);
  await clock_beyond(at.running + 0.3);
  await ask(page, 'POST', '/stop');
  await page.locator('[data-test=stopped]').waitFor();
  at.stopped = await clock_beyond(await now_s() + 1.5);
  await clock_beyond(at.stopped + 0.3);
  await resume(page);
  await ask(page, 'PUT', '/sim/speed', { speed: 10 });
  await finished(page, 'there');
  await finished(page, 'back');
  await ask(page, 'PUT', '/policy', { policy: 'sequential' });
  await ask(page, 'DELETE', '/scene/objects/crate');
  await page.locator('.policy', { hasText: 'sequential' }).waitFor();
  await ask(page, 'PUT', '/sim/speed', { speed: 1 });
});

test('Scene page shows past objects and cannot change them', { timeout: 300_000 }, async () => {
  const { page } = dashboard;
  await go_to(page, `#/scene/crate?t=${at.running.toFixed(2)}`);
  await page.locator('[data-test=objects]', { hasText: 'crate' }).waitFor();
  await says_of_then(/State at 0:0/);
  for (const change of ['object-save', 'object-remove']) await page.locator(`[data-test=${change}]:disabled`).waitFor();
  await page.screenshot(path_for('look-back-scene-dark'));
  await go_to(page, `#/scene/crate?t=${at.first.toFixed(2)}`);
  await page.locator('[data-test=objects] li').nth(1).waitFor({ state: 'detached' });
  await page.getByText('There was no object called crate.').waitFor();
});

test('Recovery page shows past needs and cannot resume', { timeout: 300_000 }, async () => {
  const { page } = dashboard;
  await go_to(page, `#/recovery?t=${at.stopped.toFixed(2)}`);
  await page.getByText('2 of 2 arms were waiting for resume.').waitFor();
  await reads(page.locator('[data-test=cause]'), /stopped: left, right/);
  await counts(page.locator('[data-test=resume-checked]'), 0);
  await page.locator('[data-test=resume-left]:disabled').waitFor();
  await page.screenshot(path_for('look-back-recovery-dark'));
  await go_to(page, `#/recovery?t=${at.running.toFixed(2)}`);
  await page.getByText('No arm was waiting for resume.').waitFor();
});

test('Alerts page shows the alerts up to the shown time', { timeout: 300_000 }, async () => {
  const { page } = dashboard;
  await go_to(page, `#/alerts?t=${at.stopped.toFixed(2)}`);
  await page.locator('[data-test=alerts]', { hasText: 'stopped: left, right' }).waitFor();
  await go_to(page, `#/alerts?t=${at.running.toFixed(2)}`);
  await page.locator('[data-test=alerts]', { hasText: 'stopped: left, right' }).waitFor({ state: 'detached' });
  await says_of_then(/as they are now/);
});

test('Policies page shows the past policy', { timeout: 300_000 }, async () => {
  const { page } = dashboard;
  await go_to(page, `#/policies?t=${at.running.toFixed(2)}`);
  await page.locator('[data-test=policy-form] input[value=coordinated]:checked').waitFor();
  await page.locator('[data-test=change-policy]:disabled').waitFor();
  await says_of_then(/comparison uses the jobs of the live server/);
  await page.screenshot(path_for('look-back-policies-dark'));
});

test('Diagram shows past progress without authority and prediction', { timeout: 300_000 }, async () => {
  const { page } = dashboard;
  await go_to(page, `#/pair/there/back?t=${at.running.toFixed(2)}`);
  await page.locator('[data-test=diagram] canvas').first().waitFor();
  await says_of_then(/not kept/);
  await page.locator('[data-test=measured]').waitFor();
  await counts(page.locator('[data-test=plan]'), 0);
  await counts(page.getByText('if neither waits'), 0);
  await counts(page.getByText('authority', { exact: true }), 0);
  await page.evaluate(() => window.armloom.drawn());
  await page.screenshot(path_for('look-back-diagram-dark'));
  await page.locator('[data-test=as-of] button').click();
  await page.locator('[data-test=as-of]').waitFor({ state: 'detached' });
  await page.getByText('if neither waits').waitFor();
});

test('The console has no errors', () => {
  assert.deepEqual(dashboard.chromium.errors, []);
});
