// A pick and place: the steps of the job, and the object in the hand.
//
//   node --test test/browser/steps.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { address_like, ask, counts, eventually, finished, go_to, path_for, reads, view_picture, web_require, with_dashboard } from './harness.mjs';
import { color_at } from './pictures.mjs';

const kAxe = readFileSync(web_require.resolve('axe-core/axe.min.js'), 'utf8');
const kPart = { name: 'part', box: [0.04, 0.04, 0.08], xyz: [-0.1, 0.35, 0.141] };
// Cell time of the wait with the part in the hand. The page must notice it on a busy machine.
const kWait_s = 60;
// Moved by a job, the part must move at least this far in the view.
const kLeastWay_px = 40;
// The blue of the left arm exceeds its red by more than twice this; the gray of objects by less.
const kBlue = 30;
// Looks at the part between the fingers: they open at right angles to this direction.
const kCamera = '0.3,0.75,0.55,-0.1,0.35,0.35';

const to = (xyz, more = {}) => ({ move_to: { pose: { link: 'left_panda_hand', xyz, rpy: [3.14159265, 0, 0.785] } }, arm: 'left', ...more });
const gripper = (width_m) => ({ gripper: { arm: 'left', width_m } });
const kHome = { move_to: { named: 'home' }, arm: 'left' };
const kPick = {
  id: 'pick', name: 'Pick and place', steps: [
    to([-0.1, 0.35, 0.4], { name: 'above' }), gripper(0.07), to([-0.1, 0.35, 0.25], { name: 'down' }), gripper(0.04),
    { attach: { object: 'part', link: 'left_panda_hand', touch: ['table'] } },
    to([-0.1, 0.35, 0.4], { name: 'lift' }), { wait_s: kWait_s }, to([-0.1, -0.35, 0.4]), to([-0.1, -0.35, 0.25], { name: 'place' }),
    { detach: { object: 'part', touch: ['table'] } }, gripper(0.07), to([-0.1, -0.35, 0.4], { name: 'retreat' }), kHome,
  ],
};

let page;
const { chromium } = with_dashboard('config/two_pandas.json', 'coordinated', {}, (opened) => { ({ page } = opened); });

const go = (hash) => go_to(page, hash);
const speed = (value) => ask(page, 'PUT', '/sim/speed', { speed: value });
const steps = page_of('[data-test=steps] li');
const row = page_of('[data-test="job-pick"]');
const card = page_of('[data-test=arm-left]');
const center = () => page.evaluate(() => window.armloom.where_is('part'));
const places = () => page.evaluate(() => [window.armloom.objects().map(({ name }) => name), window.armloom.held().map(({ object, arm }) => `${object.name} ${arm}`)]);

function page_of(selector) {
  return () => page.locator(selector);
}

/** Submits a job, which must be accepted. */
async function submit(job) {
  const { status, value } = await ask(page, 'POST', '/jobs', job);
  assert.equal(status, 202, JSON.stringify(value));
}

async function looks_blue() {
  const [r, , b] = await color_at(page.context(), await view_picture(page), await center());
  return b - r > kBlue;
}

test('The page of a job with steps marks the present step', { timeout: 300_000 }, async () => {
  assert.equal((await ask(page, 'PUT', '/scene/objects/part', kPart)).status, 201);
  await page.waitForFunction(() => window.armloom.objects().some(({ name }) => name === 'part'));
  await go(`#/?camera=${kCamera}`);
  await eventually(async () => assert.ok(!await looks_blue(), 'an object of the scene is gray'));
  await submit(kPick);
  await go(`#/job/pick?camera=${kCamera}`);
  await counts(steps(), kPick.steps.length);
  await page.locator('[data-test=steps] li[aria-current=step]', { hasText: `wait ${kWait_s} s` }).waitFor();
  assert.deepEqual(await steps().evaluateAll((all) => all.map(({ dataset }) => dataset.state)), [...Array(6).fill('done'), 'running', ...Array(6).fill('waiting')]);
  await reads(steps().nth(5), /^6\s+✓\s+lift · motion to a goal\s+left\s+done$/);
  await reads(steps().nth(4), /attach part to left_panda_hand\s+done$/);
  await reads(steps().nth(12), /motion to home/);
  await reads(row().locator('[data-test=step]'), new RegExp(`^step 7 of 13: wait ${kWait_s} s$`));
  await reads(row().locator('[data-test=reason]'), new RegExp(`^waits ${kWait_s} s$`));
  await reads(card(), new RegExp(`Pick and place\\s+step 7 of 13\\s+waits ${kWait_s} s`));
});

test('A held object is drawn in the hand, in the color of its arm', { timeout: 300_000 }, async () => {
  assert.deepEqual(await places(), [['table'], ['part left']]);
  await page.keyboard.press('Escape');
  await go(`#/?camera=${kCamera}`);
  for (const shown of ['show-distances', 'show-paths', 'show-ghosts']) await page.locator(`[data-test=${shown}]`).click();
  await page.locator('.distance-label:not([hidden])').waitFor({ state: 'detached' });
  await eventually(async () => assert.ok(await looks_blue(), 'the part has the color of the left arm'));
  await page.screenshot(path_for('held-dark'));
  // A click on it opens its page.
  const { x, y } = await center();
  await page.locator('.view canvas').click({ position: { x, y } });
  await address_like(page, /#\/scene\/part/);
  await reads(page.locator('[data-test=held-by]'), /^held by left$/);
  await reads(page.locator('[data-test=object-held]'), /^left holds part \(on left_panda_hand\)/);
  await counts(page.locator('[data-test=object-form]'), 0, 'the server refuses changes of a held object');
});

test('Cards, the page of the arm and Recovery say what an arm holds', { timeout: 300_000 }, async () => {
  await reads(card().locator('[data-test=arm-holds]'), /^holds part$/);
  await counts(page.locator('[data-test=arm-right] [data-test=arm-holds]'), 0);
  await go('#/arm/left');
  await reads(page.locator('.pane [data-test=arm-holds]'), /^Holds part$/);
  await reads(page.locator('.pane-body'), /Executes Pick and place, step 7 of 13 \(wait/);
  await reads(page.locator('.pane-body'), /Schedule\s+Pick and place: step 7 of 13 \(wait \d+ s\), end not predicted\s*$/);
  await ask(page, 'POST', '/arms/left/stop');
  await go('#/recovery');
  const need = page.locator('[data-test=need-left]');
  await reads(need.locator('[data-test=arm-holds]'), /^Holds part$/);
  await reads(need, /Resume: Pick and place continues from step 7 of 13 \(wait/);
  await counts(page.locator('[data-test=need-right] [data-test=arm-holds]'), 0);
  await page.screenshot(path_for('recovery-dark'));
  await ask(page, 'POST', '/resume');
  await page.locator('[data-test=arm-left] [data-test=arm-state]', { hasText: 'paused' }).waitFor();
});

test('A page that is opened later shows the same', { timeout: 300_000 }, async () => {
  await go('#/job/pick');
  await page.reload();
  await page.waitForFunction(() => window.armloom?.is_drawn());
  await eventually(async () => assert.deepEqual(await places(), [['table'], ['part left']]));
  await reads(card().locator('[data-test=arm-holds]'), /^holds part$/);
  await page.locator('[data-test=steps] li[aria-current=step]', { hasText: `wait ${kWait_s} s` }).waitFor();
  assert.ok(await center(), 'the part is drawn');
});

for (const theme of ['Light', 'Dark']) {
  test(`axe-core finds no violation with steps and a held object, ${theme.toLowerCase()}`, { timeout: 300_000 }, async () => {
    await go('#/settings');
    await page.getByLabel(theme, { exact: true }).check();
    await page.evaluate(kAxe);
    for (const [name, hash] of [['job', '#/job/pick'], ['arm', '#/arm/left'], ['scene', '#/scene/part'], ['recovery', '#/recovery']]) {
      await go(hash);
      await page.waitForFunction(() => document.getAnimations().every(({ playState }) => playState !== 'running'));
      const found = await page.evaluate(() => window.axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] })
        .then(({ violations }) => violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 160)} ${nodes[0].any[0]?.message ?? ''}`)));
      assert.deepEqual(found, [], hash);
      const before = page.viewportSize();
      for (const width of [390, 1280]) {
        await page.setViewportSize({ width, height: 844 });
        await eventually(async () => assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${hash} fits into ${width} px`));
        await page.screenshot(path_for(`${name}-${theme.toLowerCase()}-${width}`));
      }
      await page.setViewportSize(before);
    }
  });
}

test('The object moves with the hand, and is in the scene again where it was put down', { timeout: 300_000 }, async () => {
  await go('#/');
  const before = await center();
  const way = async () => { const now = await center(); return Math.hypot(now.x - before.x, now.y - before.y); };
  await speed(5);
  await page.waitForFunction(() => window.armloom.jobs().find(({ id }) => id === 'pick')?.step === 7);
  await speed(0.5);
  await eventually(async () => assert.ok(await way() > kLeastWay_px && (await places())[1].length === 1, 'the held part moves'));
  await speed(5);
  await finished(page, 'pick');
  assert.deepEqual(await places(), [['table', 'part'], []]);
  const [part] = await page.evaluate(() => window.armloom.objects().filter(({ name }) => name === 'part'));
  for (const [k, m] of [-0.1, -0.35, 0.141].entries()) assert.ok(Math.abs(part.xyz[k] - m) < 1e-3, JSON.stringify(part.xyz));
  assert.ok(await center(), 'it is drawn');
  await counts(page.locator('[data-test=arm-holds]'), 0);
  await go('#/job/pick');
  await counts(page.locator('[data-test=steps] li[data-state=done]'), kPick.steps.length);
  await counts(page.locator('[data-test=steps] li[aria-current=step]'), 0);
});

test('The timeline has a segment for each motion', async () => {
  const named = await page.evaluate(() => window.armloom.lanes()[0].marks.filter(({ kind, job }) => kind === 'motion' && job === 'pick').map(({ label }) => label));
  assert.deepEqual(named, [
    'above', 'gripper of left: 0.07 m', 'down', 'gripper of left: 0.04 m', 'lift', 'motion to a goal', 'place', 'gripper of left: 0.07 m', 'retreat', 'motion to home',
  ].map((step) => `Pick and place: ${step}`));
});

test('A failed job names the step at which it ended', { timeout: 300_000 }, async () => {
  await submit({ id: 'bad', steps: [kPick.steps[0], { name: 'take it', attach: { object: 'part', link: 'left_panda_hand' } }, kHome] });
  await finished(page, 'bad');
  await reads(page.locator('[data-test="job-bad"] [data-test=reason]'), /^step 2 of 3 \(take it\): part is .* mm or more from left_panda_hand/);
  await go('#/job/bad');
  await counts(steps(), 3);
  assert.deepEqual(await steps().evaluateAll((all) => all.map(({ dataset }) => dataset.state)), ['done', 'failed', 'waiting']);
  await reads(page.locator('[data-test=steps] li[aria-current=step]'), /take it · attach part to left_panda_hand\s+failed$/);
  await reads(steps().nth(2), /not done$/);
  await page.screenshot(path_for('failed-dark'));
});

test('The console has no errors', () => {
  assert.deepEqual(chromium.errors, []);
});
