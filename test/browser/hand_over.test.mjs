// Pick, hand over and place in the demo cell; and what an operator does with an object that a canceled job left in a hand.
//
//   node --test test/browser/hand_over.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { ask, counts, eventually, go_to, kRoot, path_for, reads, with_dashboard } from './harness.mjs';

const kJobs = JSON.parse(readFileSync(join(kRoot, 'config/pick_and_place_jobs.json'), 'utf8')).map(({ job }) => job);

let page;
with_dashboard('config/pick_and_place.json', 'earliest_start', {}, (opened) => { ({ page } = opened); });

const job_named = (id) => kJobs.find((job) => job.id === id);
const submit = async (job) => assert.equal((await ask(page, 'POST', '/jobs', job)).status, 202);
const ended = (id) => eventually(async () => {
  const { state, result } = (await ask(page, 'GET', `/jobs/${id}`)).value;
  assert.equal(state, 'succeeded', JSON.stringify(result));
}, 120_000);
const center = (name) => page.evaluate((of) => window.armloom.where_is(of), name);
const is_held_by = (arm) => page.waitForFunction((by) => window.armloom.held().some(({ object, arm: of }) => object.name === 'bar' && of === by), arm, { timeout: 120_000 });

test('The bar goes from hand to hand, and both arms carry their parts', { timeout: 300_000 }, async () => {
  const before = await center('bar');
  for (const id of ['left-there', 'right-there', 'hand-over-there']) await submit(job_named(id));
  await go_to(page, '#/job/hand-over-there');
  await is_held_by('left');
  await is_held_by('right');
  await page.screenshot(path_for('handed-over'));
  for (const id of ['left-there', 'right-there', 'hand-over-there']) await ended(id);
  await eventually(async () => assert.deepEqual(await page.evaluate(() => window.armloom.held()), []));
  const after = await center('bar');
  assert.ok(Math.hypot(after.x - before.x, after.y - before.y) > 20, 'the bar is drawn at its new place');
  const { value: { objects } } = await ask(page, 'GET', '/scene');
  const bar = objects.find(({ name }) => name === 'bar');
  for (const [i, at] of [0.15, 0.4, 0.181].entries()) assert.ok(Math.abs(bar.xyz[i] - at) < 0.002, bar.xyz.join());
});

test('Recovery offers to let go of what a canceled job left in the hand', { timeout: 300_000 }, async () => {
  await submit(job_named('hand-over-back'));
  await is_held_by('right');
  await go_to(page, '#/recovery');
  const need = page.locator('[data-test=need-right]');
  await reads(need.locator('[data-test=arm-holds]'), /^Holds bar$/);
  await counts(need.locator('[data-test=let-go]'), 0, 'its job is under way');
  await ask(page, 'DELETE', '/jobs/hand-over-back');
  await need.locator('[data-test=let-go]').click();
  await reads(need, /The gripper does not move/);
  await page.screenshot(path_for('let-go'));
  await need.locator('[data-test=let-go-now]').click();
  await counts(need.locator('[data-test=arm-holds]'), 0);
  const { value: { objects, held } } = await ask(page, 'GET', '/scene');
  assert.deepEqual([objects.some(({ name }) => name === 'bar'), held], [true, []]);
  const back = { id: 'back', arm: 'right', move_to: { joints: [0, -1.2, 0, -2.6, 0, 1.6, 0.785] } };
  await submit(back);
  await ended('back');
});
