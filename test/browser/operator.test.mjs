// Features for operators: jogging, comparing policies, and recognizing old data.
//
//   node --test test/browser/operator.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { arm_now, ask, counts, eventually, finished, go_to, job_through, path_for, reads, with_dashboard } from './harness.mjs';

const kMiddle = [0, -0.7, 0, -1.8, 0, 2.6, 0];

// The lease of jogging is long, so that renewals on a busy machine are in time.
let page;
const { server, chromium } = with_dashboard('config/two_pandas.json', 'certified', { more: ['--jog-lease', '3'] }, (opened) => { ({ page } = opened); });

const go = (hash) => go_to(page, hash);
const speed = (value) => ask(page, 'PUT', '/sim/speed', { speed: value });
const ended = (id) => finished(page, id);

test('Jogging lasts while a button is held: by mouse, key and finger', { timeout: 400_000 }, async () => {
  await speed(0.2);  // slow, so that even on a busy machine the button is released before the goal
  await go('#/arm/left');
  await page.locator('[data-test=control-person]').fill('Ada');
  await page.locator('[data-test=take-control]').click();
  await page.locator('[data-test=in-control]', { hasText: 'you (Ada)' }).waitFor();
  const jogs = async () => (await ask(page, 'GET', '/jobs?arm=left&limit=100')).value.jobs.filter((job) => job.name === 'jog left');
  const canceled = async (count) => {
    for (;;) {
      const jobs = await jogs();
      if (jobs.length === count && jobs.every((job) => job.result !== null)) return jobs[0];
      await page.waitForTimeout(50);
    }
  };
  const button = page.locator('[data-test=jog-ready]');
  const is_held = (yes) => page.locator(`[data-test=jog-ready][aria-pressed=${yes}]`).waitFor();
  await button.hover();
  await page.mouse.down();
  await page.locator('[data-test=jog-state]', { hasText: /running/ }).waitFor();
  await is_held(true);
  await page.screenshot(path_for('jog-dark'));
  await page.mouse.up();
  const first = await canceled(1);
  assert.ok(first.state === 'canceled' && first.progress < 1, `let go on its way: ${JSON.stringify(first.result)}`);
  await is_held(false);

  await button.focus();
  await page.keyboard.down('Space');
  await page.locator('[data-test=jog-state]', { hasText: /running/ }).waitFor();
  await page.keyboard.up('Space');
  assert.equal((await canceled(2)).state, 'canceled');

  const touch = await page.context().newCDPSession(page);
  await touch.send('Emulation.setTouchEmulationEnabled', { enabled: true });
  await page.waitForFunction(() => navigator.maxTouchPoints > 0);
  const { x, y, width, height } = await button.boundingBox();
  const finger = (type, dx = 0) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: type === 'touchEnd' ? [] : [{ x: x + width / 2 + dx, y: y + height / 2 }] });
  await finger('touchStart');
  await page.locator('[data-test=jog-state]', { hasText: /running/ }).waitFor();
  await finger('touchMove', 15);  // fingers never lie still
  await is_held(true);
  assert.equal((await jogs()).filter((job) => job.result === null).length, 1);
  await finger('touchEnd');
  assert.equal((await canceled(3)).state, 'canceled');
  await is_held(false);
  await touch.send('Emulation.setTouchEmulationEnabled', { enabled: false });
  await touch.detach();

  // Another user takes control: the motion ends, and the page names the user.
  await button.hover();
  await page.mouse.down();
  await page.locator('[data-test=jog-state]', { hasText: /running/ }).waitFor();
  await ask(page, 'POST', '/control', { who: 'Bob', take: true });
  await page.locator('[data-test=take-control]', { hasText: 'Take control from Bob' }).waitFor();
  await page.mouse.up();
  assert.equal((await canceled(4)).state, 'canceled');
  await page.locator('[data-test=in-control]', { hasText: 'Bob' }).waitFor();
  await page.locator('[data-test=take-control]').click();
  await page.locator('[data-test=release-control]').click();
  await page.locator('[data-test=in-control]').waitFor({ state: 'detached' });
  await ask(page, 'POST', '/jobs', { id: 'back-home', arm: 'left', move_to: { named: 'home' } });
  await speed(10);
  await ended('back-home');
});

test('Policies page compares the policies and activates another one', { timeout: 500_000 }, async () => {
  await speed(10);
  const arms = ['left', 'right'];
  for (const arm of arms) await page.locator(`[data-test=arm-${arm}] [data-test=arm-state]`, { hasText: 'idle' }).waitFor();
  const from = await Promise.all(arms.map((arm) => arm_now(page, arm)));
  for (let i = 0; i < 3; i++) {
    for (const [k, { names, q }] of from.entries()) {
      const { status, value } = await ask(page, 'POST', '/jobs', job_through(`${arms[k]}-${i}`, names, [q, kMiddle, q], 2));
      assert.equal(status, 202, JSON.stringify(value));
    }
  }
  await ended('right-2');
  await ended('left-2');
  await go('#/policies');
  await page.locator('[data-test=compare]').click();
  await page.locator('[data-test=comparison-state]', { hasText: /: done$/ }).waitFor({ timeout: 150_000 });
  const rows = page.locator('[data-test=compared] tbody tr');
  await counts(rows, 7);
  await reads(page.locator('[data-test=compared-sequential]'), /\d+ of \d+.*100 %/s);
  await counts(page.locator('[data-test=compared-certified]').getByText('active', { exact: true }), 1);
  await page.screenshot(path_for('policies-dark'));
  await page.locator('[data-test=use-coordinated]').click();
  await page.locator('[data-test=compared-coordinated]').getByText('active', { exact: true }).waitFor();
  await page.locator('[data-test=use-certified]').click();
  await page.locator('[data-test=compared-certified]').getByText('active', { exact: true }).waitFor();
});

test('Speed override is set by keyboard, applies in motion, and follows other clients', { timeout: 300_000 }, async () => {
  await speed(1);
  await go('#/');
  const value = (which) => page.locator(`[data-test=speed-${which}-value]`);
  const slider = (which) => page.locator(`[data-test=speed-${which}]`);
  const told = async (path) => (await ask(page, 'GET', path)).value.speed_override;
  await slider('cell').focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press('PageDown');
  await reads(value('cell'), /^50 %$/);
  await eventually(async () => assert.equal(await told('/speed'), 0.5));
  await reads(value('left'), /^100 % → 50 %$/);

  const { names, q } = await arm_now(page, 'left');
  assert.equal((await ask(page, 'POST', '/jobs', job_through('slow', names, [q, kMiddle, q], 4))).status, 202);
  await page.locator('[data-test=list-running] [data-test=job-slow]').waitFor();
  await slider('left').focus();
  await page.keyboard.press('Home');
  await reads(value('left'), /^0 % → 0 %$|^0 %$/);
  await page.locator('[data-test=arm-left] [data-test=arm-state]', { hasText: 'paused' }).waitFor();
  await page.locator('[data-test=arm-left] [data-test=arm-waits]', { hasText: 'until the speed override is raised' }).waitFor();
  await page.screenshot(path_for('speed-dark'));

  await ask(page, 'PUT', '/arms/left/speed', { speed_override: 0.8 });  // another client
  await reads(value('left'), /^80 % → 40 %$/);
  assert.equal(await slider('left').inputValue(), '80');
  await page.locator('[data-test=arm-left] [data-test=arm-state]', { hasText: 'moving' }).waitFor();
  for (const path of ['/speed', '/arms/left/speed']) await ask(page, 'PUT', path, { speed_override: 1 });
  await speed(10);
  await ended('slow');
  await speed(1);
});

// The connection stays open, but the server sends no data.
test('Old data is marked with its age until new data arrives', { timeout: 300_000 }, async () => {
  const age_s = async (locator) => Number((await locator.textContent()).match(/([\d.]+) s/)[1]);
  const saturation = () => page.evaluate(() => getComputedStyle(document.querySelector('.view')).filter);
  await eventually(async () => assert.equal(await saturation(), 'none'));
  server.freeze();
  const stale = page.locator('[data-test=stale]');
  await stale.waitFor();
  const first_s = await age_s(stale);
  assert.ok(first_s >= 2, `${first_s} s`);
  await eventually(async () => assert.match(await saturation(), /grayscale/));
  await reads(page.locator('[data-test=link]'), /no data for/);
  await page.locator('.stale-time').waitFor();
  await page.screenshot(path_for('stale-dark'));
  await page.waitForFunction((first_s) => Number(document.querySelector('[data-test=stale]').textContent.match(/([\d.]+) s/)[1]) > first_s, first_s);
  server.thaw();
  await stale.waitFor({ state: 'detached' });
  await page.locator('[data-test=link].open').waitFor();
  await eventually(async () => assert.equal(await saturation(), 'none'));
});

test('The console has no errors', () => {
  // After another user took control, the server may have refused a renewal that was on its way.
  assert.deepEqual(chromium.errors.filter((text) => !/409 \(Conflict\).*\/jog$/.test(text)), []);
});
