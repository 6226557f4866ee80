// The dashboard's pages as a user sees them. Covers addresses, the predicted timeline, keys, past
// times, themes, axe-core, names that contain HTML, and a server restart.
//
//   node --test test/browser/pages.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { address_like, arm_now, ask, counts, eventually, go_to, job_through, label_of, path_for, reads, resume, send_through, web_require, with_dashboard } from './harness.mjs';

const kStop = 'Stop all: controlled, drives stay powered';
const kMiddle = [0, -0.7, 0, -1.8, 0, 2.6, 0];
const kAxe = readFileSync(web_require.resolve('axe-core/axe.min.js'), 'utf8');
// A name that would run a script if the page used it as HTML.
const kHostile = '<img src=x onerror="window.was_html=1"><b>&amp;';

let page;
let url;
const { server, chromium } = with_dashboard('config/two_pandas.json', 'coordinated', {}, (opened) => { ({ page, url } = opened); });

const send = (...job) => send_through(page, ...job);

const go = (hash) => go_to(page, hash);

// The paths of both jobs cross in the middle. The right job is admitted behind the left job, and
// pauses or waits for it.
test('Timeline shows predicted motions and waits with their blockers', { timeout: 300_000 }, async () => {
  await ask(page, 'PUT', '/sim/speed', { speed: 0.05 });  // slow, so that a busy machine keeps up
  await send('left', 'first', [kMiddle, null], 6, { name: 'to the middle' });
  await send('right', 'second', [kMiddle, null], 6, { name: 'behind it' });
  await page.waitForFunction(() => window.armloom.lanes().find((lane) => lane.arm === 'right')
    ?.marks.some((mark) => mark.expected && mark.kind !== 'motion' && mark.waits_on?.arm === 'left'));
  for (const words of [/behind it waits for job first of left/, /behind it: (expected|running)/]) await page.locator('[data-test=lane-text-right]', { hasText: words }).waitFor({ state: 'attached' });
  const row = page.locator('[data-test="job-second"]');
  await reads(row.locator('[data-test=when]'), /starts in about|ends in about|about to start/);
  await page.screenshot(path_for('timeline-dark'));

  // A click on a predicted bar of the right arm opens the page of its job.
  const canvas = page.locator('.timeline canvas');
  const { width, height } = await canvas.boundingBox();
  const lane = Math.min(54, (height - 18) / 2);
  await canvas.hover({ position: { x: 72 + (width - 82) * 0.86, y: lane * 1.4 } });
  await reads(page.locator('.tip'), /behind it/);
  await canvas.click({ position: { x: 72 + (width - 82) * 0.86, y: lane * 1.4 } });
  await page.locator('[data-test=page-job] h2').waitFor();
  await reads(page.locator('[data-test=page-job] h2'), /^behind it$/);
  await address_like(page, /#\/job\/second/);
  await page.screenshot(path_for('job-dark'));
  await ask(page, 'PUT', '/sim/speed', { speed: 1 });
});

test('Timeline can be dragged and zoomed, and follows now again', { timeout: 180_000 }, async () => {
  const canvas = page.locator('.timeline canvas');
  const shown = async () => [Number(await canvas.getAttribute('data-from')), Number(await canvas.getAttribute('data-length'))];
  const { x, y, width } = await canvas.boundingBox();
  const drag = async (dx) => {
    await page.mouse.move(x + width / 2, y + 20);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + dx, y + 20, { steps: 8 });
    await page.mouse.up();
  };
  await drag(80);
  await page.waitForFunction(() => document.querySelector('.timeline canvas').dataset.from !== 'now');
  const [before_s, length_s] = await shown();
  await drag(-120);
  await eventually(async () => {
    const moved_px = (((await shown())[0] - before_s) / length_s) * (width - 82);
    assert.ok(Math.abs(moved_px - 120) < 4, `120 px were dragged, ${moved_px} px moved`);
  });
  await page.mouse.wheel(0, -100);
  await page.waitForFunction((length_s) => Number(document.querySelector('.timeline canvas').dataset.length) < length_s, length_s);
  await page.locator('[data-test=follow-now]').click();
  await page.waitForFunction(() => document.querySelector('.timeline canvas').dataset.from === 'now');
});

test('An address reproduces job, time and camera in another tab', { timeout: 300_000 }, async () => {
  await go('#/job/second');
  // The user turns the view and selects a past time.
  const view = await page.locator('.view canvas').boundingBox();
  await page.mouse.move(view.x + view.width * 0.8, view.y + view.height * 0.3);
  await page.mouse.down();
  await page.mouse.move(view.x + view.width * 0.8 + 60, view.y + view.height * 0.3 + 15, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction(() => /camera=/.test(location.hash));
  const scrub = page.locator('[data-test=scrub]');
  await scrub.focus();
  for (let i = 0; i < 12; i++) await page.keyboard.press('ArrowLeft');
  await page.locator('[data-test=instant]').waitFor();
  // Moves forward to a time at which the job existed.
  const { submitted_s } = (await ask(page, 'GET', '/jobs/second')).value;
  const instant_s = async () => Number(/[?&]t=([\d.]+)/.exec(await address_like(page, /[?&]t=\d/))[1]);
  for (let i = 0; i < 12 && await instant_s() < submitted_s + 0.1; i++) await page.keyboard.press('ArrowRight');
  const address = await address_like(page, /#\/job\/second\?t=\d/);

  const other = await chromium.context.newPage();
  await other.goto(address);
  // The new page knows the job's name once it has the server's snapshot.
  await other.locator('[data-test=page-job] h2', { hasText: 'behind it' }).waitFor();
  assert.equal(await other.evaluate(() => location.href), address);
  // The new page has loaded the earlier data from the server.
  await other.locator('[data-test=instant]').waitFor();
  const middle_s = () => other.locator('[data-test=lanes]').evaluate(({ dataset }) => Number(dataset.from) + Number(dataset.length) / 2);
  const held_s = Number(/[?&]t=([\d.]+)/.exec(address)[1]);
  assert.ok(Math.abs(await middle_s() - held_s) < 0.01, 'its timeline stands around that instant');
  // The address is parsed before the page knows the current time. The page must not clamp such a
  // time, even if it seems to be in the future.
  await go_to(other, '#/?t=7200');
  await other.reload();
  await other.locator('[data-test=lanes]').waitFor();
  assert.equal(await middle_s(), 7200);
  // For a time without data the page shows no pose, not even the pose of another time.
  await go_to(other, '#/?t=3&run=00000000');
  await other.locator('[data-test=unheard]', { hasText: 'another server session' }).waitFor();
  await other.locator('[data-test=instant]').waitFor({ state: 'detached' });
  await other.waitForFunction(() => window.armloom?.is_drawn());
  await other.evaluate(() => window.armloom.drawn());
  await counts(other.locator('.arm-label:visible'), 0, 'no arm stands anywhere then');
  await other.screenshot(path_for('unheard-dark'));
  await other.locator('[data-test=unheard-now]').click();
  await other.locator('[data-test=unheard]').waitFor({ state: 'detached' });
  await other.close();

  await page.locator('[data-test=follow-now]').click();
  await page.locator('[data-test=instant]').waitFor({ state: 'detached' });
  await address_like(page, /^(?!.*[?&]t=)/);
});

test('A click on an arm or object opens its page and highlights it in all views', { timeout: 300_000 }, async () => {
  await go('#/');
  await page.evaluate(() => window.armloom.drawn());
  // An arm's base is above the center of its label.
  const label = await label_of(page, 'left').boundingBox();
  await page.mouse.click(label.x + label.width / 2, label.y - 34);
  await page.locator('[data-test=page-arm]').waitFor();
  await address_like(page, /#\/arm\/left/);
  await reads(page.locator('[data-test=controller]'), /simulated by the server.*\d\.\d of 1\.0 mrad/s);
  await label_of(page, 'left').and(page.locator('.lit')).waitFor();
  await page.locator('[data-test=arm-left].lit').waitFor();
  await page.evaluate(() => window.armloom.drawn());
  const view = await page.locator('.view canvas').boundingBox();
  await page.mouse.click(view.x + view.width * 0.75, view.y + view.height * 0.75);
  await page.locator('[data-test=page-scene]').getByText('Change table').waitFor();
});

test('Keys open pages, and F8 stops also from a text field', { timeout: 300_000 }, async () => {
  await page.locator('.logo').click();
  await page.keyboard.press('h');
  await page.locator('[data-test=page-history]').waitFor();
  await page.keyboard.press('Escape');
  await page.locator('[data-test=page-history]').waitFor({ state: 'detached' });
  await page.keyboard.press('n');
  const text = page.locator('[data-test=job-text]');
  await text.fill('');
  await text.focus();
  await page.keyboard.type('hc');
  assert.equal(await text.inputValue(), 'hc', 'letters that are typed lead nowhere');
  await page.keyboard.press('F8');
  await page.locator('[data-test=stopped]').waitFor();
  await page.screenshot(path_for('stopped-dark'));
  await resume(page);
  await page.locator('[data-test=stopped]').waitFor({ state: 'detached' });
  assert.equal(await page.getByRole('button', { name: kStop }).count(), 1);
  await text.fill('');
});

test('Scene page adds, moves and removes objects', { timeout: 300_000 }, async () => {
  await page.locator('[data-test=go-scene]').click();
  const fill = async (values) => { for (const [key, value] of Object.entries(values)) await page.locator(`[data-test=object-${key}]`).fill(value); };
  await fill({ name: 'can' });
  // The page must not drop a comma silently: 0,15 m would become 15 m.
  await page.locator('[data-test=object-size_x]').fill('');
  await page.locator('[data-test=object-size_x]').pressSequentially('0,15');
  await page.locator('[data-test=object-save]').click();
  await reads(page.locator('[data-test=problem]'), /size x: "0,15" is not a number: use a decimal point/);
  await fill({ size_x: '0.15' });
  await page.locator('[data-test=object-size_x]').press('ArrowUp');
  assert.equal(await page.locator('[data-test=object-size_x]').inputValue(), '0.16');
  await page.locator('[data-test=object-kind]').selectOption('cylinder');
  await fill({ radius: '0.08', length: '0.3', x: '-0.3', y: '0.9', z: '0.4', roll: '90' });
  await page.locator('[data-test=object-save]').click();
  await page.waitForFunction(() => window.armloom.objects().some((object) => object.name === 'can' && object.cylinder?.[0] === 0.08 && Math.abs(object.rpy[0] - Math.PI / 2) < 1e-6));
  await page.waitForURL(/#\/scene\/can/);
  await page.getByRole('heading', { name: 'Change can' }).waitFor();
  await fill({ x: '0.3' });
  await page.locator('[data-test=object-save]').click();
  await page.waitForFunction(() => window.armloom.objects().some((object) => object.name === 'can' && object.xyz[0] === 0.3));
  // Typed input stays while the object changes. The other fields follow the object.
  await fill({ length: '-1' });
  await ask(page, 'PUT', '/scene/objects/can', { cylinder: [0.08, 0.3], xyz: [0.35, 0.9, 0.4], rpy: [Math.PI / 2, 0, 0] });
  await page.waitForFunction(() => document.querySelector('[data-test=object-x]').value === '0.35');
  assert.equal(await page.locator('[data-test=object-length]').inputValue(), '-1');
  await page.locator('[data-test=object-save]').click();
  await reads(page.locator('[data-test=problem]'), /cylinder|length|greater|positive|> 0/i);
  await page.screenshot(path_for('scene-dark'));
  await page.locator('[data-test=object-remove]').click();
  await page.locator('[data-test=object-removal]').click();
  await page.waitForFunction(() => !window.armloom.objects().some((object) => object.name === 'can'));
});

test('Names never become HTML', { timeout: 300_000 }, async () => {
  await page.locator('[data-test=list-finished] [data-test="job-second"]').waitFor();  // then the right arm is at rest
  await page.evaluate(() => { window.was_html = 0; });
  const { names, q } = await arm_now(page, 'right');
  const job = job_through('hostile', names, [q, q.map((v, k) => v + (k === 0 ? 0.2 : 0)), q], 2, { name: kHostile });
  assert.equal((await ask(page, 'POST', '/jobs', job)).status, 202);
  const object = await ask(page, 'PUT', `/scene/objects/${encodeURIComponent('<b>crate')}`, { box: [0.1, 0.1, 0.1], xyz: [-0.3, 0.9, 0.4], rpy: [0, 0, 0] });
  assert.ok(object.status < 300, JSON.stringify(object.value));
  await page.locator('[data-test="job-hostile"]').getByText(kHostile).waitFor();
  for (const hash of ['#/job/hostile', '#/history', '#/scene', `#/scene/${encodeURIComponent('<b>crate')}`, `#/job/${encodeURIComponent(kHostile)}`, `#/${kHostile}`]) {
    await go(hash);
    await page.locator('.pane').waitFor();
    assert.equal(await page.evaluate(() => document.querySelectorAll('.pane img, .side img, .pane h2 b, .objects b, .dock img').length), 0, hash);
  }
  await page.locator('[data-test=list-finished] [data-test="job-hostile"]').waitFor();
  assert.equal(await page.evaluate(() => window.was_html), 0);
  // Blank, reversed, very long and piled-up names: none may pass for another name or break a line.
  const strange = { blank: '   ', turned: '\u202edeeccus', long: 'W'.repeat(256), piled: `a${'\u0301'.repeat(200)}`, hebrew: '\u05e9\u05dc\u05d5\u05dd 7' };
  for (const [id, name] of Object.entries(strange)) {
    const { names, q } = await arm_now(page, 'right');
    assert.equal((await ask(page, 'POST', '/jobs', job_through(`name-${id}`, names, [q, q], 1, { name }))).status, 202);
  }
  // Waits until the jobs have ended, because their rows move between the lists until then.
  const row = (id) => page.locator(`[data-test=list-finished] [data-test="job-name-${id}"]`);
  for (const id of Object.keys(strange)) await row(id).waitFor();
  await row('blank').getByText('(blank)').first().waitFor({ state: 'attached' });
  await row('turned').getByText('⟨U+202E⟩deeccus').first().waitFor({ state: 'attached' });
  const before = page.viewportSize();
  for (const width of [1024, 1440]) {
    await page.setViewportSize({ width, height: 800 });
    for (const hash of ['#/job/name-long', '#/job/name-turned', '#/history', '#/pair/name-long/first']) {
      await go(hash);
      await page.locator('.pane h2').first().waitFor();
      const wide = () => page.evaluate(() => [document.documentElement, document.querySelector('.pane-body'), document.querySelector('.jobs'), ...document.querySelectorAll('.job')].filter((box) => box.scrollWidth > box.clientWidth + 1).map((box) => box.className || box.tagName));
      await eventually(async () => assert.deepEqual(await wide(), [], `${hash} at ${width} px`));
      assert.doesNotMatch(await page.title(), /\u202e/);
    }
    // Ids stay visible next to long names. Scrolls first, because rows out of view have no layout.
    await row('long').scrollIntoViewIfNeeded();
    await eventually(async () => assert.ok(await row('long').locator('.id').evaluate((id) => id.checkVisibility() && id.clientWidth > 30), `${width} px`));
    await page.screenshot(path_for(`names-${width}`));
  }
  await page.setViewportSize(before);
  await go('#/');
  // Even if a name were used as HTML, the content security policy would block its script.
  const stopped = await page.evaluate((html) => new Promise((done) => {
    document.addEventListener('securitypolicyviolation', (event) => done(event.violatedDirective), { once: true });
    const place = document.createElement('div');
    document.body.append(place);
    place.innerHTML = html;
    place.remove();
  }), kHostile);
  assert.match(stopped, /script-src/);
  assert.equal(await page.evaluate(() => window.was_html), 0);
  await ask(page, 'DELETE', `/scene/objects/${encodeURIComponent('<b>crate')}`);
});

const kPages = ['#/', '#/new', '#/scene', '#/scene/table', '#/history', '#/settings', '#/alerts', '#/recovery', '#/recordings', '#/policies', '#/job/first', '#/arm/left', '#/pair/first/second', '#/nowhere'];

for (const theme of ['Dark', 'Light']) {
  test(`axe-core finds no violation on any page, ${theme.toLowerCase()}`, { timeout: 400_000 }, async () => {
    await go('#/settings');
    await page.getByLabel(theme, { exact: true }).check();
    await page.waitForFunction((theme) => document.documentElement.dataset.theme === theme, theme.toLowerCase());
    // The debugger injects axe, which works under any content security policy.
    await page.evaluate(kAxe);
    const all = [];
    for (const hash of kPages) {
      await go(hash);
      await page.locator(hash === '#/' ? 'main' : '.pane h2').first().waitFor();
      if (/arm|job/.test(hash)) await page.locator('.uplot').waitFor();
      if (/pair/.test(hash)) await page.locator('[data-test=diagram] canvas').first().waitFor();
      await page.waitForFunction(() => document.getAnimations().every(({ playState }) => playState !== 'running'));  // waits for color transitions
      const found = await page.evaluate(() => window.axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] })
        .then(({ violations }) => violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 4).map((node) => `${node.html.slice(0, 120)} ${node.any[0]?.message ?? ''}`).join(' | ')}`)));
      await page.screenshot(path_for(`page-${theme.toLowerCase()}-${hash.replaceAll(/[^a-z]+/g, '-').replaceAll(/^-|-$/g, '') || 'cell'}`));
      all.push(...found.map((words) => `${hash}: ${words}`));
    }
    assert.deepEqual(all, []);
  });
}

test('Targets measure 24 px and the focus is visible', { timeout: 180_000 }, async () => {
  await go('#/job/first');
  const small = await page.evaluate(() => [...document.querySelectorAll('button, a, input, select, canvas[tabindex]')]
    .map((element) => ({ element, box: element.getBoundingClientRect() }))
    // Links within sentences may be small. Radio buttons and checkboxes can be clicked on their
    // labels.
    .filter(({ element, box }) => box.width > 1 && !element.matches('.link, input[type=radio], input[type=checkbox]') && (box.height < 23.5 || box.width < 23.5))
    .map(({ element, box }) => `${element.outerHTML.slice(0, 90)} ${box.width.toFixed(0)} x ${box.height.toFixed(0)}`));
  assert.deepEqual(small, []);
  await page.keyboard.press('Tab');
  await eventually(async () => assert.equal(await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle), 'solid'));
});

test('Header fits into one line at all widths', { timeout: 300_000 }, async () => {
  await go('#/');
  await ask(page, 'POST', '/stop');
  const { value: { key } } = await ask(page, 'POST', '/control', { who: 'Maximiliane von Hohenstein-Wartburg, second shift' });
  await page.locator('[data-test=open-alerts]').waitFor();
  await page.locator('[data-test=in-control]').waitFor();
  const before = page.viewportSize();
  for (const width of [1024, 1180, 1280, 1366, 1440, 1600, 1920]) {
    await page.setViewportSize({ width, height: 800 });
    await eventually(async () => {
      const { policy, covered, beyond, stop } = await page.evaluate(() => {
        const header = document.querySelector('.header');
        const boxes = [...header.children].filter((child) => child.checkVisibility() && getComputedStyle(child).position !== 'absolute').map((child) => ({ what: child.textContent, box: child.getBoundingClientRect() })).filter(({ box }) => box.width > 1);
        const covered = boxes.slice(1).filter(({ box }, i) => box.left < boxes[i].box.right - 0.5).map(({ what }) => what);
        const policy = document.querySelector('[data-test=go-policies]');
        return { policy: policy.checkVisibility() && policy.innerText, covered, beyond: header.scrollWidth - header.clientWidth, stop: document.querySelector('.stop').getBoundingClientRect().right };
      });
      assert.equal(policy, 'coordinated', `${width} px`);
      assert.deepEqual(covered, [], `covered at ${width} px`);
      assert.equal(beyond, 0, `the header goes beyond ${width} px`);
      assert.ok(stop <= width && stop > width - 24, `Stop ends at ${stop} of ${width} px`);
    });
    await page.screenshot(path_for(`header-${width}`));
  }
  await page.setViewportSize(before);
  await ask(page, 'POST', '/control/release', { control: key });
  await ask(page, 'POST', '/resume');
});

test('Navigation reaches every page by mouse and by keys', { timeout: 300_000 }, async () => {
  for (const [button, shown] of [['go-alerts', 'page-alerts'], ['go-recovery', 'page-recovery'], ['go-compare', 'page-policies'], ['go-recordings', 'page-recordings'], ['go-settings', 'page-settings']]) {
    await page.locator('[data-test=more-pages]').click();
    await page.locator(`[data-test=${button}]`).click();
    await page.locator(`[data-test=${shown}]`).waitFor();
    await counts(page.locator('.more-pages[open]'), 0, 'it closes');
  }
  await reads(page.locator('[data-test=more-pages]'), /^\s*Settings▾\s*$/);
  // The menu works by keys alone: it opens, steps through its entries, and closes without leaving
  // the page.
  await page.locator('[data-test=more-pages]').focus();
  await page.keyboard.press('Enter');
  await page.keyboard.press('Tab');
  await page.locator('[data-test=go-recordings]:focus').waitFor();
  await page.screenshot(path_for('more-pages'));
  await page.keyboard.press('Escape');
  await counts(page.locator('.more-pages[open]'), 0);
  assert.equal(await page.locator('[data-test=page-settings]').count(), 1);
  await page.locator('[data-test=go-diagram]').click();
  await page.locator('[data-test=diagram] canvas').first().waitFor();
  await address_like(page, /#\/pair\/left\/right/);
});

// The last jobs of both arms have ended: the measured path is drawn.
test('Diagram of two arms follows their jobs and shows the measured path', { timeout: 300_000 }, async () => {
  await go('#/pair/left/right');
  await page.locator('[data-test=diagram] canvas').first().waitFor();
  await send('left', 'pair-left', [kMiddle, null], 3);
  await send('right', 'pair-right', [kMiddle, null], 3);
  await page.locator('[data-test=diagram][aria-label*="pair-left (across) and pair-right (up)"]').waitFor();
  await eventually(async () => assert.equal(await page.getByLabel('Across: an arm or a job').inputValue(), 'left'));
  for (const id of ['pair-left', 'pair-right']) await page.locator(`[data-test=list-finished] [data-test="job-${id}"]`).waitFor();
  await page.locator('[data-test=measured]').waitFor();
  await go('#/pair/pair-left/pair-right');
  await page.locator('[data-test=measured]').waitFor();
  await page.screenshot(path_for('pair-measured'));
  await page.getByLabel('Up: an arm or a job').selectOption('left');
  await page.locator('[data-test=no-pair]').waitFor();
  await go('#/');
});

test('The console has no errors', () => {
  assert.deepEqual(chromium.errors.filter((text) => !/404 \(Not Found\).*\/(x$|jobs\/%3Cimg)|422 \(.*\/scene\/objects\/can|inline event handler violates/.test(text)), []);
});

test('Page reconnects to a restarted server without a reload', { timeout: 300_000 }, async () => {
  await page.evaluate(() => { window.never_reloaded = true; });
  await go('#/');
  await server.end();
  await page.locator('[data-test=lost]').waitFor();
  await page.screenshot(path_for('lost-light'));
  assert.equal(await server.start(), url);
  await page.locator('[data-test=lost]').waitFor({ state: 'detached' });
  await page.locator('[data-test=link].open').waitFor();
  await page.waitForFunction(() => window.armloom.jobs().length === 0);
  await page.getByText('The server was restarted').first().waitFor();
  await send('left', 'afterwards', [kMiddle, null], 2);
  await page.locator('[data-test=list-finished] [data-test="job-afterwards"]').waitFor();
  const { missed, doubled } = await page.evaluate(() => window.armloom.numbers());
  assert.deepEqual([missed, doubled], [0, 0]);
  assert.equal(await page.evaluate(() => window.never_reloaded), true);
});
