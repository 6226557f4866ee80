// Accessibility of the dashboard: by keys alone, by touch on a tablet, and without colors.
//
//   node --test test/browser/everybody.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { address_like, ask, Browser, eventually, go_to, label_of, looks_different, path_for, reads, resume, send_through, view_picture, with_dashboard } from './harness.mjs';
import { difference, pixels_like } from './pictures.mjs';

const kMiddle = [0, -0.7, 0, -1.8, 0, 2.6, 0];
const kFinger_px = 36;
const kMostTabs = 120;
const kTurned_px = 2000;
const kMostEvents = 100;
const kLeastEvent_px = 12;
const kLeastScrub_px = 90;
// The hatching of undecided cells (web/src/state/palette.ts), as seen without colors.
const kStripes_gray = [0x4e, 0x4e, 0x4e];
const kLeastStripes_px = 40;

let url;
let page;
let finger;
const tablet = new Browser();
const { chromium: desk } = with_dashboard('config/two_pandas.json', 'certified', {}, (opened) => { ({ page, url } = opened); });
after(() => tablet.close(), { timeout: 120_000 });

const send = (...job) => send_through(page, ...job);

/** Presses Tab until this element has the focus. */
async function tab_to(selector, key = 'Tab') {
  for (let i = 0; i < kMostTabs; i++) {
    await page.keyboard.press(key);
    if (await page.evaluate((selector) => document.activeElement.matches(selector), selector)) return;
  }
  assert.fail(`${selector} is not reached in ${kMostTabs} steps`);
}

const focus_is_on = (what, words) => eventually(async () => assert.equal(await page.evaluate(() => document.activeElement.dataset.test ?? document.activeElement.className), what, words));

test('Keys and buttons turn the 3D view without dragging', { timeout: 400_000 }, async () => {
  const first = await view_picture(page);
  await tab_to('[data-test=view]');
  for (const key of ['ArrowRight', 'ArrowRight', 'ArrowUp', '+']) await page.keyboard.press(key);
  await looks_different(page, first, kTurned_px);
  await address_like(page, /camera=/);
  await page.keyboard.press('0');
  await address_like(page, /^(?!.*camera=)/);
  await page.locator('[data-test=camera-left]').click();
  await address_like(page, /camera=/);
  await page.locator('[data-test=camera-whole]').click();
  await address_like(page, /^(?!.*camera=)/);
  await page.mouse.move(5, 5);
  await page.evaluate(() => document.activeElement.blur());
  await eventually(async () => {
    const whole = await difference(desk.context, first, await view_picture(page));
    assert.ok(whole.count < kTurned_px / 10, `${whole.count} pixels are elsewhere`);
  });
});

test('Keys alone suffice to plan, send, inspect and cancel a job', { timeout: 300_000 }, async () => {
  await tab_to('[data-test=new-job]', 'Shift+Tab');
  await page.keyboard.press('Enter');
  await page.locator('[data-test=page-new]').waitFor();
  await focus_is_on('page-new', 'what was opened has the focus');
  await tab_to('summary');
  await page.keyboard.press('Enter');
  await tab_to('[data-test=plan-named]');
  await page.keyboard.type('ready');
  await tab_to('[data-test=plan]');
  await page.keyboard.press('Enter');
  await page.locator('[data-test=planned]').waitFor();
  await ask(page, 'PUT', '/sim/speed', { speed: 0.05 });
  await tab_to('[data-test=send]');
  await page.keyboard.press('Enter');
  const accepted = page.locator('[data-test=accepted] a');
  const id = await accepted.innerText();
  await page.keyboard.press('Escape');
  await page.locator('.pane').waitFor({ state: 'detached' });
  await focus_is_on('new-job', 'who had the focus before has it again');
  await page.locator(`[data-test=list-running] [data-test="job-${id}"]`).waitFor();
  await tab_to('.cancel');
  await page.keyboard.press('Enter');
  await page.locator('[data-test=confirm-cancel]').waitFor();
  await page.keyboard.press('Enter');
  await ask(page, 'PUT', '/sim/speed', { speed: 10 });
  await page.locator(`[data-test=list-finished] [data-test="job-${id}"]`).waitFor();
});

test('Sticky bars never cover the focused element', { timeout: 300_000 }, async () => {
  // Slow, so that the reports stay visible for the next test.
  await ask(page, 'PUT', '/sim/speed', { speed: 0.1 });
  await ask(page, 'POST', '/stop');
  for (let i = 0; i < 12; i++) await send(i % 2 === 0 ? 'left' : 'right', `waits-${i}`, [null], 1);
  await page.locator('[data-test="job-waits-11"]').waitFor();
  for (const size of [{ width: 820, height: 700 }, { width: 1280, height: 600 }]) {
    await page.setViewportSize(size);
    await page.locator('[data-test="job-waits-11"] .cancel').focus();
    const hidden = [];
    for (let i = 0; i < 40; i++) {
      await page.keyboard.press('Shift+Tab');
      hidden.push(...await page.evaluate(() => {
        const { activeElement: element } = document;
        const { left, top, width, height } = element.getBoundingClientRect();
        const sticky = document.elementsFromPoint(left + width / 2, top + Math.min(height / 2, 12)).find((one) => /^(sticky|fixed)$/.test(getComputedStyle(one).position) && !one.contains(element));
        return sticky ? [`${element.outerHTML.slice(0, 80)} under ${sticky.tagName} ${sticky.className}`] : [];
      }));
    }
    assert.deepEqual(hidden, [], `${size.width} px`);
  }
  await page.setViewportSize({ width: 1440, height: 900 });
});

test('Timeline marks events; keys and clicks go to their times', { timeout: 300_000 }, async () => {
  await page.evaluate(() => window.armloom.drawn());
  await page.locator('[data-test=stopped]').waitFor();
  await eventually(async () => {
    const strip = await page.locator('.timeline canvas').screenshot();
    const found = await Promise.all([[0xff, 0x70, 0x78], [0xf0, 0xb5, 0x41]].map((rgb) => pixels_like(desk.context, strip, rgb, 12)));
    assert.ok(Math.max(...found) > kLeastEvent_px, `${found} pixels of marks`);
  });
  // Keys that arrive faster than frames: the first opens the tooltip, Escape closes it, the third
  // opens it again.
  const told_after = await page.evaluate(async () => {
    const canvas = document.querySelector('[data-test=lanes]');
    canvas.focus();
    const told = [];
    for (const key of ['PageUp', 'Escape', 'PageUp']) {
      canvas.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true }));
      await null;
      told.push(document.querySelector('.timeline .tip') !== null);
    }
    return told;
  });
  assert.deepEqual(told_after, [true, false, true]);
  // The same by real keys. Enter then shows the time of the event in all views.
  const [tip, canvas] = [page.locator('.timeline .tip'), page.locator('[data-test=lanes]')];
  const kTold = /^Warning at 0:\d\d:\d\d\.\d, (\d+ min )?[\d.]+ s ago: stopped: left, right \(operator\)/m;
  const to_the_stop = async () => {
    await canvas.focus();
    await page.keyboard.press('Escape');  // the next Page Up then shows the newest event
    // On a busy machine the server may also report delays, which are skipped here.
    for (let i = 0; i < kMostEvents; i++) {
      await page.keyboard.press('PageUp');
      if (kTold.test(await tip.innerText())) return;
    }
    assert.fail(await tip.innerText());
  };
  const follow_now = async () => {
    await page.locator('[data-test=instant]').waitFor();
    await page.locator('[data-test=follow-now]').click();
    await page.locator('[data-test=instant]').waitFor({ state: 'detached' });
  };
  await to_the_stop();
  await page.locator('.timeline [role=status]', { hasText: kTold }).waitFor({ state: 'attached' });
  await page.screenshot(path_for('event-tip-dark'));
  await page.keyboard.press('Enter');
  await follow_now();
  await to_the_stop();
  const [told, lanes] = [await tip.boundingBox(), await canvas.boundingBox()];
  await page.keyboard.press('Escape');
  await tip.waitFor({ state: 'detached' });
  // By pointer: the tooltip shows the event, and a click goes to its time.
  const notch = { x: told.x + told.width / 2, y: lanes.y + lanes.height - 22 };
  await page.mouse.move(notch.x, notch.y - 30);
  await page.mouse.move(notch.x, notch.y);
  await reads(tip, kTold);
  await page.mouse.click(notch.x, notch.y);
  await follow_now();
  await page.locator('.notices [data-test^=then-]').first().click();
  await page.locator('[data-test=instant]').waitFor();
  await address_like(page, /[?&]t=\d/);
  const [scrub, zoom] = [await page.locator('[data-test=scrub]').boundingBox(), await page.getByRole('button', { name: 'Zoom out' }).boundingBox()];
  assert.ok(scrub.width >= kLeastScrub_px && scrub.x + scrub.width <= zoom.x, `the scrub bar is ${scrub.width} px wide, from ${scrub.x}; its neighbour begins at ${zoom.x}`);
  await page.screenshot(path_for('event-marks-dark'));
  await page.locator('[data-test=follow-now]').click();
  await page.locator('[data-test=instant]').waitFor({ state: 'detached' });
  await ask(page, 'PUT', '/sim/speed', { speed: 10 });
});

test('Touch alone suffices on a tablet', { timeout: 500_000 }, async () => {
  finger = await tablet.open({ colorScheme: 'light', viewport: { width: 1024, height: 768 }, hasTouch: true, isMobile: true });
  await tablet.visit(url);
  const small = await finger.evaluate((least) => [...document.querySelectorAll('button, select, summary, input[type=search]')]
    .map((element) => ({ element, box: element.getBoundingClientRect() }))
    .filter(({ box }) => box.width > 1 && Math.min(box.height, box.width) < least)
    .map(({ element, box }) => `${element.outerHTML.slice(0, 90)} ${box.width.toFixed(0)} x ${box.height.toFixed(0)}`), kFinger_px - 0.5);
  assert.deepEqual(small, []);
  await finger.screenshot(path_for('tablet-light'));
  // The priority buttons are visible without hovering, which a finger cannot do.
  await finger.locator('[data-test="job-waits-3"]').getByRole('button', { name: 'More urgent: waits-3' }).tap();
  await finger.locator('[data-test="job-waits-3"]').getByText('+1', { exact: true }).waitFor();
  // A finger turns the view, and selects an arm.
  const touch = await tablet.context.newCDPSession(finger);
  const view = await finger.locator('.view canvas').boundingBox();
  const at = (dx) => ({ x: view.x + view.width * 0.7 + dx, y: view.y + view.height * 0.25 });
  await touch.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [at(0)] });
  for (let i = 1; i <= 5; i++) await touch.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: [at(12 * i)] });
  await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await finger.waitForFunction(() => /camera=/.test(location.hash));
  await finger.locator('[data-test=camera-whole]').tap();
  await finger.evaluate(() => window.armloom.drawn());
  const label = await label_of(finger, 'left').boundingBox();
  await finger.touchscreen.tap(label.x + label.width / 2, label.y - 30);
  await finger.locator('[data-test=page-arm]').waitFor();
  await finger.setViewportSize({ width: 820, height: 1180 });
  await finger.locator('[data-test=page-arm] .uplot').waitFor();
  await eventually(async () => assert.equal(await finger.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0, 'nothing is beside the page'));
  await finger.screenshot(path_for('tablet-upright-light'));
  for (let i = 0; i < 12; i++) await ask(finger, 'DELETE', `/jobs/waits-${i}`);
  await resume(finger, (locator) => locator.tap());
  await finger.locator('[data-test=stopped]').waitFor({ state: 'detached' });
  await finger.locator('[data-test=stop]').tap();
  await finger.locator('[data-test=stopped]').waitFor();
  await resume(finger, (locator) => locator.tap());
  await finger.locator('[data-test=stopped]').waitFor({ state: 'detached' });
  assert.deepEqual(tablet.errors, []);
});

test('Diagrams are readable without colors', { timeout: 300_000 }, async () => {
  await ask(page, 'PUT', '/sim/speed', { speed: 1 });
  await ask(page, 'POST', '/stop');
  await send('left', 'grey-left', [kMiddle, null], 6);
  await send('right', 'grey-right', [kMiddle, null], 6);
  const eyes = await desk.context.newCDPSession(page);
  await eyes.send('Emulation.setEmulatedVisionDeficiency', { type: 'achromatopsia' });
  await go_to(page, '#/pair/grey-left/grey-right');
  const diagram = page.locator('[data-test=diagram]');
  await diagram.locator('canvas').first().waitFor();
  await eventually(async () => {
    const stripes = await pixels_like(desk.context, await diagram.screenshot(), kStripes_gray, 10);
    assert.ok(stripes > kLeastStripes_px, `${stripes} pixels of stripes`);
  });
  await page.screenshot(path_for('diagram-without-colours'));
  await eyes.send('Emulation.setEmulatedVisionDeficiency', { type: 'none' });
});

test('The console has no errors', () => {
  assert.deepEqual(desk.errors, []);
});
