// The page agrees with itself: before and after a reload, and on screens of every size. A job that an
// object blocks says so, and the page offers what helps.
//
//   node --test test/browser/agreement.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ask, eventually, finished, go_to, path_for, reads, send_through, with_dashboard } from './harness.mjs';

const kMiddle = [0, -0.7, 0, -1.8, 0, 2.6, 0];
// The left arm reaches out and up: to its right, and to its left.
const kRight = [-1.4, -0.4, 0, -1.2, 0, 2.0, 0.785];
const kLeft = [1.4, ...kRight.slice(1)];
// Between these two poses.
const kCrate = { box: [0.15, 0.15, 0.2], xyz: [-0.05, 0, 1.15], rpy: [0, 0, 0] };

let page;
const { chromium } = with_dashboard('config/two_pandas.json', 'coordinated', {}, (opened) => { ({ page } = opened); });

const go = (hash) => go_to(page, hash);
const job_now = async (id) => (await ask(page, 'GET', `/jobs/${id}`)).value;
const state_is = (id, state) => eventually(async () => assert.equal((await job_now(id)).state, state));
const arm_is = (arm, state) => eventually(async () => assert.equal((await ask(page, 'GET', `/arms/${arm}`)).value.state, state));

/** Returns what the timeline draws of the time before `until_s`: marks and stops of each arm. */
const drawn_until = (until_s) => page.evaluate((until_s) => {
  const round = (t_s) => Math.round(Math.min(t_s ?? Infinity, until_s) * 20) / 20;
  const lanes = window.armloom.lanes().map(({ arm, marks }) => [arm, marks.filter(({ expected, from_s }) => !expected && from_s < until_s - 0.1)
    .map(({ kind, job, from_s, to_s, stopped }) => `${kind} ${job} ${round(from_s)} to ${round(to_s)}${stopped ? ' stopped' : ''}`).sort()]);
  const halts = Object.entries(window.armloom.halts()).map(([arm, all]) => [arm, all.filter(({ from_s }) => from_s < until_s - 0.1).map(({ from_s, to_s }) => `${round(from_s)} to ${round(to_s)}`)]);
  return { lanes, halts };
}, until_s);

test('Timeline shows the same motions, pauses and stops after a reload', { timeout: 300_000 }, async () => {
  await send_through(page, 'left', 'first', [kMiddle, null], 3);
  await send_through(page, 'right', 'second', [kMiddle, null], 3);
  await state_is('first', 'running');
  await ask(page, 'POST', '/arms/left/stop');
  await arm_is('left', 'stopped');
  await page.waitForTimeout(1000);
  await ask(page, 'POST', '/arms/left/resume');
  for (const id of ['first', 'second']) await finished(page, id);
  await send_through(page, 'left', 'third', [kMiddle, null], 3);
  await state_is('third', 'running');
  await ask(page, 'POST', '/arms/left/stop');
  await arm_is('left', 'stopped');
  await page.waitForTimeout(500);
  const until_s = (await ask(page, 'GET', '/timeline')).value.now_s;
  await eventually(async () => assert.ok(await page.evaluate((until_s) => document.querySelector('[data-test=clock]') && window.armloom.lanes().some(({ marks }) => marks.some(({ to_s }) => Number.isFinite(to_s) && to_s > until_s)), until_s)));
  const before = await drawn_until(until_s);
  const [left] = before.lanes;
  assert.ok(left[1].filter((mark) => /^pause (first|third) .* stopped$/.test(mark)).length === 2, `no stops: ${left[1].join('; ')}`);
  assert.equal(before.halts.find(([arm]) => arm === 'left')[1].length, 2, JSON.stringify(before.halts));
  await page.screenshot(path_for('timeline-before-reload'));
  await page.reload();
  await page.locator('[data-test=link].open').waitFor();
  await eventually(async () => assert.deepEqual(await drawn_until(until_s), before));
  await page.screenshot(path_for('timeline-after-reload'));
  await ask(page, 'POST', '/arms/left/resume');
  await finished(page, 'third');
});

test('Stop is at the same place on phones, tablets and screens, in every state', { timeout: 300_000 }, async () => {
  const before = page.viewportSize();
  const places = [];
  const look = async (what) => {
    for (const [width, height] of [[360, 740], [768, 1024], [1280, 800], [1920, 1080]]) {
      await page.setViewportSize({ width, height });
      const { stop, resume, hit, beyond } = await page.evaluate(() => {
        const box = (element) => { const { left, right, top, bottom } = element.getBoundingClientRect(); return { left, right, top, bottom }; };
        const stop = document.querySelector('.stop');
        const at = box(stop);
        const hit = document.elementFromPoint((at.left + at.right) / 2, (at.top + at.bottom) / 2);
        return { stop: at, resume: box(document.querySelector('.resume')), hit: stop.contains(hit), beyond: document.documentElement.scrollWidth - window.innerWidth };
      });
      const where = `${what}, ${width} x ${height}`;
      assert.ok(stop.left >= 0 && hit, `${where}: Stop is covered or out of sight`);
      assert.ok(resume.right <= stop.left && resume.top === stop.top, `${where}: Resume is not at the left of Stop`);
      assert.ok(beyond <= 0, `${where}: the page is wider than the window by ${beyond} px`);
      places.push({ where, right_px: width - stop.right, top_px: stop.top, bottom_px: stop.bottom });
      await page.screenshot(path_for(`stop-${what.replaceAll(' ', '-')}-${width}`));
    }
  };
  await look('nothing to resume');
  await ask(page, 'POST', '/stop');
  await page.locator('[data-test=to-resume]:not([disabled])').waitFor();
  await page.locator('[data-test=open-alerts]').waitFor();
  await look('stopped with alerts');
  await ask(page, 'POST', '/resume');
  await page.locator('[data-test=to-resume][disabled]').waitFor();
  await look('resumed');
  const [{ right_px, top_px, bottom_px }] = places;
  assert.deepEqual(places.filter((one) => one.right_px !== right_px || one.top_px !== top_px || one.bottom_px !== bottom_px), [], JSON.stringify(places));
  await page.setViewportSize(before);
});

test('A job that an object blocks has no false end, and three ways on that work', { timeout: 400_000 }, async () => {
  const row = (id) => page.locator(`[data-test=list-running] [data-test="job-${id}"]`);
  /** Sends the left arm on its way to a pose, and puts the crate in front of it. */
  const block = async (id, to) => {
    await send_through(page, 'left', id, [to], 5);
    await eventually(async () => assert.ok((await job_now(id)).progress > 0.05));
    const { status, value } = await ask(page, 'PUT', '/scene/objects/crate', kCrate);
    assert.ok(status < 300, JSON.stringify(value));
    await state_is(id, 'paused');
    await reads(row(id).locator('[data-test=when]'), /^paused for .*, until crate is moved/);
  };
  await go('#/');
  await send_through(page, 'left', 'begins', [kRight], 4);
  await finished(page, 'begins');
  await block('moved', kLeft);
  assert.doesNotMatch(await row('moved').innerText(), /ends in/);
  const step = (await ask(page, 'GET', '/timeline')).value.arms.flatMap(({ steps }) => steps).find(({ id }) => id === 'moved');
  assert.equal(step.ends_s, null);
  await page.screenshot(path_for('blocked-by-crate'));
  await row('moved').locator('[data-test=move-blocker]').click();
  await page.locator('[data-test=move-object][aria-pressed=true]').waitFor();
  await page.locator('[data-test=object-y]').fill('0.9');
  await page.locator('[data-test=object-save]').click();
  await finished(page, 'moved');

  await go('#/');
  await block('around', kRight);
  await row('around').locator('[data-test=replan]').click();
  await row('around').getByRole('button', { name: 'Brake and replan' }).click();
  await state_is('around', 'succeeded');
  assert.equal((await job_now('around')).replan.done, 1);
  await ask(page, 'DELETE', '/scene/objects/crate');

  await block('given-up', kLeft);
  await row('given-up').locator('[data-test=cancel-job]').click();
  await row('given-up').locator('[data-test=confirm-cancel]').click();
  await state_is('given-up', 'canceled');
  await ask(page, 'DELETE', '/scene/objects/crate');
});

test('The console has no errors', () => {
  assert.deepEqual(chromium.errors, []);
});
