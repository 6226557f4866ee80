// Visibility: each page when it is opened by its address, Stop next to any content of the
// header, buttons in all states, answers of forms, and names and numbers in narrow windows.
//
//   node --test test/browser/sight.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { arm_now, ask, eventually, go_to, job_through, path_for, reads, send_through, with_dashboard } from './harness.mjs';

const kMiddle = [0, -0.7, 0, -1.8, 0, 2.6, 0];

let page;
let url;
const { server, chromium } = with_dashboard('config/two_pandas.json', 'coordinated', {}, (opened) => { ({ page, url } = opened); });

const go = (hash) => go_to(page, hash);

/**
 * Returns the texts, links and controls of header and pane. Each number is replaced by 0, because
 * numbers change all the time.
 */
const told = () => {
  const of = (root) => [root.innerText, ...[...root.querySelectorAll('a, button, input, select, option')].map((one) => `${one.tagName} ${one.textContent} ${one.getAttribute('href')} ${one.disabled} ${one.title}`)].join('\n');
  return [...document.querySelectorAll('header, .pane')].map(of).join('\n').replace(/\d+/g, '0');
};

const kPages = ['#/', '#/new', '#/scene', '#/scene/table', '#/history', '#/settings', '#/alerts', '#/recovery', '#/recordings', '#/policies', '#/job/done', '#/arm/left', '#/pair/left/right', '#/pair/done/other'];

test('A page opened by its address shows the same as when a user returns to it', { timeout: 600_000 }, async () => {
  await send_through(page, 'left', 'done', [kMiddle, null], 3);
  await send_through(page, 'right', 'other', [kMiddle, null], 3);
  for (const id of ['done', 'other']) await page.locator(`[data-test=list-finished] [data-test="job-${id}"]`).waitFor();
  for (const hash of kPages) {
    const other = await chromium.context.newPage();
    await other.setViewportSize({ width: 800, height: 450 });  // small, because the view is drawn for each of fourteen pages
    await other.goto(`${url}${hash}`);
    await other.locator('[data-test=link].open').waitFor();
    await other.waitForFunction(() => window.armloom?.is_drawn());
    if (hash !== '#/') await other.locator('.pane h2').first().waitFor();
    // Waits until the page no longer changes.
    const settled = async () => {
      for (let before = null, same = 0; ;) {
        const now = await other.evaluate(told);
        same = now === before && !/Drawing…|Not connected/.test(now) ? same + 1 : 0;
        if (same === 4) return now;
        before = now;
        await other.waitForTimeout(150);
      }
    };
    const opened = await settled();
    await go_to(other, '#/nowhere');
    await other.getByText('Page not found').waitFor();
    await go_to(other, hash);
    if (hash !== '#/') await other.locator('.pane h2').first().waitFor();
    assert.equal(opened, await settled(), hash);
    await other.close();
  }
});

test('A fresh page links to the arms diagram and can compare policies', { timeout: 300_000 }, async () => {
  const other = await chromium.context.newPage();
  await other.goto(url);
  await other.locator('[data-test=go-diagram][href="#/pair/left/right"]').waitFor();
  await other.locator('[data-test=go-diagram]').click();
  await other.locator('[data-test=page-pair]').waitFor();
  await other.goto('about:blank');
  await other.goto(`${url}#/policies`);
  await other.locator('[data-test=compare]:enabled').waitFor();
  await other.close();
});

test('Stop stays completely visible in the same place for any header content', { timeout: 300_000 }, async () => {
  await go('#/');
  const before = page.viewportSize();
  const places = {};
  await ask(page, 'POST', '/stop');
  const { value: { key } } = await ask(page, 'POST', '/control', { who: 'Maximiliane von Hohenstein-Wartburg, second shift' });
  await page.locator('[data-test=open-alerts]').waitFor();
  await page.locator('[data-test=in-control]').waitFor();
  const look = async (what, seen) => {
    for (const width of [1024, 1280, 1440]) {
      await page.setViewportSize({ width, height: 720 });
      const look_at_it = () => page.evaluate((seen) => {
        const { left, right, top, bottom } = document.querySelector('.stop').getBoundingClientRect();
        const facts = document.querySelector('.facts').getBoundingClientRect();
        const whole = (test) => {
          const box = document.querySelector(`[data-test=${test}]`)?.getBoundingClientRect();
          return box !== undefined && box.left >= facts.left - 1 && box.right <= facts.right + 1 && box.bottom <= facts.bottom && box.width > 8;
        };
        const header = document.querySelector('.header');
        return { stop: { left, right, top, bottom }, beyond: header.scrollWidth - header.clientWidth, missing: seen.filter((test) => !whole(test)) };
      }, seen);
      await eventually(async () => {
        const found = await look_at_it();
        assert.equal(found.beyond, 0, `${what}: the header goes beyond ${width} px`);
        assert.deepEqual(found.missing, [], `${what}: hidden at ${width} px`);
        assert.ok(found.stop.right <= width - 8, `${what}: Stop ends at ${found.stop.right} of ${width} px`);
        places[width] ??= found.stop;
        assert.deepEqual(found.stop, places[width], `${what}: Stop is elsewhere at ${width} px`);
      });
      await page.screenshot(path_for(`header-${what.replaceAll(' ', '-')}-${width}`));
    }
  };
  await look('alert and control', ['link', 'open-alerts', 'in-control', 'go-policies']);
  // Facts that do not fit are hidden. They are reached by Tab, and become visible with the focus.
  await page.setViewportSize({ width: 920, height: 720 });
  await page.locator('[data-test=open-alerts]').focus();
  await page.keyboard.press('Tab');
  await page.locator('[data-test=go-policies]:focus').waitFor();
  await eventually(async () => {
    const { at, facts } = await page.evaluate(() => ({ at: document.activeElement.getBoundingClientRect(), facts: document.querySelector('.facts').getBoundingClientRect() }));
    assert.ok(at.bottom <= facts.bottom && at.left >= facts.left, 'what has the focus is out of sight');
  });
  await ask(page, 'POST', '/control/release', { control: key });
  await page.locator('[data-test=in-control]').waitFor({ state: 'detached' });
  await look('alert', ['link', 'open-alerts', 'go-policies', 'clock']);
  await go('#/recordings');
  await page.locator('[data-test=recording-files]').setInputFiles([
    { name: 'states.csv', mimeType: 'text/csv', buffer: Buffer.from('time_s,left_panda_joint1\n0,0\n1,0.1\n') },
    { name: 'events.jsonl', mimeType: 'application/json', buffer: Buffer.from('') },
  ]);
  await page.locator('[data-test=link].recording').waitFor();
  await look('alert and recording', ['link', 'open-alerts', 'go-policies']);
  await page.locator('[data-test=recording-close]').click();
  await page.locator('[data-test=link].open').waitFor();
  await go('#/');
  await server.end();
  await page.locator('[data-test=link].lost').waitFor();
  await look('alert and disconnected', ['link', 'open-alerts', 'go-policies']);
  assert.equal(await server.start(), url);
  await page.locator('[data-test=link].open').waitFor();
  await page.setViewportSize(before);
});

/**
 * Returns the contrast ratio (WCAG) of a button's text to its background. Translucent backgrounds
 * are blended with what is behind them.
 */
const contrast = (button) => {
  const parts = (text) => { const [r, g, b, a = 1] = (text.match(/[\d.]+/g) ?? [0, 0, 0, 0]).map(Number); return [r, g, b, a]; };
  const grounds = [];
  for (let at = button; at; at = at.parentElement) grounds.unshift(parts(getComputedStyle(at).backgroundColor));
  const ground = grounds.reduce((under, [r, g, b, a]) => [r, g, b].map((v, i) => v * a + under[i] * (1 - a)), [255, 255, 255]);
  const light = (rgb) => { const [r, g, b] = rgb.slice(0, 3).map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const [dark, bright] = [light(parts(getComputedStyle(button).color)), light(ground)].sort((a, b) => a - b);
  return (bright + 0.05) / (dark + 0.05);
};

test('Buttons have sufficient contrast in all states and both themes', { timeout: 300_000 }, async () => {
  let looked = 0;
  const read = async (button, state) => {
    await page.waitForFunction(() => document.getAnimations().every(({ playState }) => playState !== 'running'));
    const ratio = await button.evaluate(contrast);
    looked += 1;
    assert.ok(ratio >= 4.5, `${await button.innerText()} ${state}: ${ratio.toFixed(2)}`);
  };
  for (const theme of ['Light', 'Dark']) {
    await go('#/settings');
    await page.getByLabel(theme, { exact: true }).check();
    await page.waitForFunction((theme) => document.documentElement.dataset.theme === theme, theme.toLowerCase());
    for (const [hash, ...tests] of [['#/new', 'send', 'check-job'], ['#/scene/table', 'object-save', 'object-remove', 'move-object'], ['#/recovery', 'resume-checked'], ['#/policies', 'compare']]) {
      await go(hash);
      for (const name of ['stop', 'to-resume', ...tests]) {
        const button = page.locator(`[data-test=${name}]`);
        await button.waitFor();
        await read(button, `at rest, ${theme}`);
        if (await button.isDisabled()) continue;
        await button.hover();
        await read(button, `pointed at, ${theme}`);
        await page.mouse.down();
        await read(button, `pressed, ${theme}`);
        await page.mouse.move(2, 2);  // moves away before the release, so that the button does nothing
        await page.mouse.up();
        await button.focus();
        await read(button, `with the focus, ${theme}`);
      }
      if (hash === '#/new') {
        await page.locator('[data-test=job-text]').fill('{');
        await page.locator('[data-test=send]').hover();
        await read(page.locator('[data-test=send]'), `pointed at, ${theme}`);
        await page.locator('[data-test=job-text]').fill('');
      }
    }
  }
  assert.ok(looked > 40, `${looked} were looked at`);
});

/** Returns true if the pane shows the whole element, or as much of it as fits. */
const in_pane = (element) => {
  const box = element.getBoundingClientRect();
  const pane = document.querySelector('.pane-body').getBoundingClientRect();
  return box.height > 0 && box.top >= pane.top - 1 && (box.bottom <= pane.bottom + 1 || box.height > pane.height - 40);
};

const is_in_pane = (locator, what) => eventually(async () => assert.ok(await locator.evaluate(in_pane), what));

test('Answers of forms are scrolled into view', { timeout: 300_000 }, async () => {
  const before = page.viewportSize();
  await page.setViewportSize({ width: 1280, height: 640 });
  await page.keyboard.press('Escape');
  await go('#/scene');
  await page.locator('[data-test=object-name]').fill('in the way');
  for (const [key, value] of Object.entries({ x: '-0.5', y: '0', z: '0.3' })) await page.locator(`[data-test=object-${key}]`).fill(value);
  await page.locator('[data-test=object-save]').click();
  await page.locator('[data-test=problem]').waitFor();
  await is_in_pane(page.locator('[data-test=problem]'), 'why it was refused');
  await page.screenshot(path_for('answer-scene'));

  await go('#/new');
  const { names, q } = await arm_now(page, 'left');
  await page.locator('[data-test=job-text]').fill(JSON.stringify(job_through('far', names, [q, q.map(() => 9)], 3), null, 2));
  await page.locator('[data-test=check-job]').click();
  await page.locator('[data-test=check-results]').waitFor();
  await is_in_pane(page.locator('[data-test=check-results]'), 'the check results');
  await page.locator('[data-test=send]').click();
  await page.locator('.in-sight > [data-test=problem]').waitFor();
  await is_in_pane(page.locator('.in-sight > [data-test=problem]'), 'why it was not sent');
  await page.screenshot(path_for('answer-new'));
  await page.setViewportSize(before);
});

test('A second press does not send a job again', { timeout: 300_000 }, async () => {
  await go('#/new');
  const { names, q } = await arm_now(page, 'left');
  const { trajectory } = job_through('', names, [q, q], 1);
  await page.locator('[data-test=job-text]').fill(JSON.stringify({ name: 'once', trajectory }));
  await page.locator('[data-test=send]').dblclick();
  await page.locator('[data-test=accepted]').waitFor();
  await reads(page.locator('[data-test=send]'), /^Send again$/);
  await page.locator('[data-test=job-text]').press('Control+Enter');
  await page.waitForTimeout(300);
  const named = () => page.evaluate(() => window.armloom.jobs().filter(({ name }) => name === 'once').length);
  assert.equal(await named(), 1);
  await page.locator('[data-test=send]').click();
  await page.waitForFunction(() => window.armloom.jobs().filter(({ name }) => name === 'once').length === 2);
  await page.locator('[data-test=job-text]').fill(JSON.stringify({ name: 'another', trajectory }));
  await reads(page.locator('[data-test=send]'), /^Send$/);
});

test('An invalid object name is reported at its field', { timeout: 180_000 }, async () => {
  await go('#/scene');
  await page.locator('[data-test=object-name]').fill('a/b');
  await page.locator('[data-test=object-name-fault]', { hasText: 'found /' }).waitFor();
  await page.locator('[data-test=object-save]:disabled').waitFor();
  await page.screenshot(path_for('object-name'));
  await page.locator('[data-test=object-name]').fill('a b');
  await page.locator('[data-test=object-save]:enabled').waitFor();
  await reads(page.locator('[data-test=object-name-fault]'), /^$/);
});

test('Narrow windows show joint values, job names and ids', { timeout: 300_000 }, async () => {
  await ask(page, 'POST', '/stop');
  const { names, q } = await arm_now(page, 'right');
  const long = 'right: tiled deposit of the second layer, then home';
  for (const job of [{ id: 'r0-right-1-to-tiled-deposit-2', name: long }, { id: 'h7', name: long }]) {
    const { status, value } = await ask(page, 'POST', '/jobs', job_through(job.id, names, [q, q], 1, { name: job.name }));
    assert.equal(status, 202, JSON.stringify(value));
  }
  const before = page.viewportSize();
  for (const width of [1024, 1280]) {
    await page.setViewportSize({ width, height: 720 });
    await go('#/arm/left');
    await page.locator('[data-test=joints-left] td').first().waitFor();
    await eventually(async () => {
      const table = await page.locator('[data-test=joints-left]').evaluate((table) => {
        const pane = document.querySelector('.pane-body');
        return { beyond: pane.scrollWidth - pane.clientWidth, right: table.getBoundingClientRect().right - pane.getBoundingClientRect().right };
      });
      assert.equal(table.beyond, 0, `the joints go ${table.beyond} px beyond their pane at ${width} px`);
      assert.ok(table.right <= 0);
    });
    for (const id of ['r0-right-1-to-tiled-deposit-2', 'h7']) {
      const row = page.locator(`[data-test="job-${id}"]`);
      await row.waitFor();
      await eventually(async () => {
        const { name_px, id_whole } = await row.evaluate((row) => {
          const [name, id] = [row.querySelector('.title'), row.querySelector('.id')];
          return { name_px: name.clientWidth, id_whole: id.scrollWidth <= id.clientWidth && id.checkVisibility() };
        });
        assert.ok(name_px >= 90, `${id}: ${name_px} px of its name at ${width} px`);
        assert.ok(id_whole, `${id} is cut at ${width} px`);
      });
    }
    await page.screenshot(path_for(`narrow-${width}`));
  }
  await page.setViewportSize(before);
});

test('Standalone links measure 24 px', { timeout: 180_000 }, async () => {
  await go('#/policies');
  const { height } = await page.locator('[data-test=go-policies]').boundingBox();
  assert.ok(height >= 24, `${height} px`);
});

test('The console has no errors', () => {
  assert.deepEqual(chromium.errors.filter((text) => !/ 422 |409 |ERR_CONNECTION_REFUSED|WebSocket/.test(text)), []);
});
