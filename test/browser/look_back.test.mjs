// While an earlier instant is looked at every page is of that instant, or says what of it is of now.
//
//   node --test test/browser/look_back.test.mjs      (after the server and web/dist were built; see harness.mjs)

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ask, finished, go_to, path_for, resume, send_through, with_dashboard } from './harness.mjs';

const kMiddle = [0, -0.7, 0, -1.8, 0, 2.6, 0];

const dashboard = with_dashboard('config/two_pandas.json', 'coordinated');
/** Cell times: before anything, while both jobs ran, while all was stopped. */
const at = {};

const now_s = async () => {
  const [hours, minutes, seconds] = (await dashboard.page.locator('[data-test=clock]').innerText()).split(':').map(Number);
  return 3600 * hours + 60 * minutes + seconds;
};
const as_of = () => dashboard.page.locator('[data-test=as-of]').innerText();

test('something happens, and is over', { timeout: 180_000 }, async () => {
  const { page } = dashboard;
  await page.waitForTimeout(1500);
  at.first = await now_s();
  await page.waitForTimeout(500);
  await ask(page, 'PUT', '/scene/objects/crate', { box: [0.2, 0.2, 0.2], xyz: [0, 1.2, 0.2], rpy: [0, 0, 0] });
  await send_through(page, 'left', 'there', [kMiddle, null], 3);
  await send_through(page, 'right', 'back', [kMiddle, null], 3);
  await page.locator('[data-test=list-running] [data-test="job-there"]').waitFor();
  await page.waitForTimeout(1500);
  at.running = await now_s();
  await page.waitForTimeout(300);
  await ask(page, 'POST', '/stop');
  await page.locator('[data-test=stopped]').waitFor();
  await page.waitForTimeout(1500);
  at.stopped = await now_s();
  await page.waitForTimeout(300);
  await resume(page);
  await finished(page, 'there');
  await finished(page, 'back');
  await ask(page, 'PUT', '/policy', { policy: 'sequential' });
  await ask(page, 'DELETE', '/scene/objects/crate');
  await page.locator('.policy', { hasText: 'sequential' }).waitFor();
});

test('the scene has the objects of that instant, and cannot be changed there', { timeout: 60_000 }, async () => {
  const { page } = dashboard;
  await go_to(page, `#/scene/crate?t=${at.running.toFixed(2)}`);
  await page.locator('[data-test=objects]', { hasText: 'crate' }).waitFor();
  assert.match(await as_of(), /As it was at 0:0/);
  for (const change of ['object-save', 'object-remove']) assert.equal(await page.locator(`[data-test=${change}]`).isDisabled(), true, change);
  await page.screenshot(path_for('look-back-scene-dark'));
  await go_to(page, `#/scene/crate?t=${at.first.toFixed(2)}`);
  await page.locator('[data-test=objects] li').nth(1).waitFor({ state: 'detached' });
  await page.getByText('There was no object of the name crate.').waitFor();
});

test('recovery tells what each arm needed then, and resumes nothing', { timeout: 60_000 }, async () => {
  const { page } = dashboard;
  await go_to(page, `#/recovery?t=${at.stopped.toFixed(2)}`);
  await page.getByText('2 of 2 arms stood until they would be resumed.').waitFor();
  assert.match(await page.locator('[data-test=cause]').innerText(), /stopped: left, right/);
  assert.equal(await page.locator('[data-test=resume-checked]').count(), 0);
  assert.equal(await page.locator('[data-test=resume-left]').isDisabled(), true);
  await page.screenshot(path_for('look-back-recovery-dark'));
  await go_to(page, `#/recovery?t=${at.running.toFixed(2)}`);
  await page.getByText('No arm waited to be resumed.').waitFor();
});

test('alerts are those that had been told', { timeout: 60_000 }, async () => {
  const { page } = dashboard;
  await go_to(page, `#/alerts?t=${at.stopped.toFixed(2)}`);
  await page.locator('[data-test=alerts]', { hasText: 'stopped: left, right' }).waitFor();
  await go_to(page, `#/alerts?t=${at.running.toFixed(2)}`);
  await page.locator('[data-test=alerts]', { hasText: 'stopped: left, right' }).waitFor({ state: 'detached' });
  assert.match(await as_of(), /as it is now/);
});

test('the policy is the one that was in force', { timeout: 60_000 }, async () => {
  const { page } = dashboard;
  await go_to(page, `#/policies?t=${at.running.toFixed(2)}`);
  await page.locator('[data-test=policy-form] input[value=coordinated]:checked').waitFor();
  assert.equal(await page.locator('[data-test=change-policy]').isDisabled(), true);
  assert.match(await as_of(), /comparison beside it is of now/);
  await page.screenshot(path_for('look-back-policies-dark'));
});

test('a diagram shows where both were, without what nobody knows of then', { timeout: 60_000 }, async () => {
  const { page } = dashboard;
  await go_to(page, `#/pair/there/back?t=${at.running.toFixed(2)}`);
  await page.locator('[data-test=diagram] canvas').first().waitFor();
  assert.match(await as_of(), /not kept/);
  await page.locator('[data-test=measured]').waitFor();
  assert.equal(await page.locator('[data-test=plan]').count(), 0);
  assert.equal(await page.getByText('plan from now').count(), 0);
  assert.equal(await page.getByText('authority', { exact: true }).count(), 0);
  await page.evaluate(() => window.armloom.drawn());
  await page.screenshot(path_for('look-back-diagram-dark'));
  await page.locator('[data-test=as-of] button').click();
  await page.locator('[data-test=as-of]').waitFor({ state: 'detached' });
  await page.getByText('plan from now').waitFor();
});

test('nothing so far was an error in the console', () => {
  assert.deepEqual(dashboard.chromium.errors, []);
});
