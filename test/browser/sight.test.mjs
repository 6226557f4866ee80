// What is there is seen, and seen whole: each page when it is opened by its address, Stop beside whatever the
// header has to say, buttons pointed at, what a form answers, and names, ids and figures in narrow windows.
//
//   node --test test/browser/sight.test.mjs      (after the server and web/dist were built; see harness.mjs)

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { arm_now, ask, Browser, job_through, path_for, send_through, Server } from './harness.mjs';

const kMiddle = [0, -0.7, 0, -1.8, 0, 2.6, 0];

const server = new Server('config/two_pandas.json', 'coordinated');
const chromium = new Browser();
let url;
let page;

before(async () => {
  url = await server.start();
  page = await chromium.open({ colorScheme: 'dark' });
  await chromium.visit(url);
}, { timeout: 90_000 });

after(async () => {
  await chromium.close();
  await server.end();
}, { timeout: 30_000 });

const go = (hash) => page.evaluate((hash) => { location.hash = hash; }, hash);

/** What the header and the pane say, lead to and let one do; figures change meanwhile. */
const told = () => {
  const of = (root) => [root.innerText, ...[...root.querySelectorAll('a, button, input, select, option')].map((one) => `${one.tagName} ${one.textContent} ${one.getAttribute('href')} ${one.disabled} ${one.title}`)].join('\n');
  return [...document.querySelectorAll('header, .pane')].map(of).join('\n').replace(/\d+/g, '0');
};

const kPages = ['#/', '#/new', '#/scene', '#/scene/table', '#/history', '#/settings', '#/alerts', '#/recovery', '#/recordings', '#/policies', '#/job/done', '#/arm/left', '#/pair/left/right', '#/pair/done/other'];

test('a page that is opened by its address shows what it does when one comes back to it', { timeout: 240_000 }, async () => {
  await send_through(page, 'left', 'done', [kMiddle, null], 3);
  await send_through(page, 'right', 'other', [kMiddle, null], 3);
  for (const id of ['done', 'other']) await page.locator(`[data-test=list-finished] [data-test="job-${id}"]`).waitFor({ timeout: 40_000 });
  for (const hash of kPages) {
    const other = await chromium.context.newPage();
    await other.goto(`${url}${hash}`);
    await other.locator('[data-test=link].open').waitFor();
    await other.waitForFunction(() => window.armloom?.is_drawn());
    if (hash !== '#/') await other.locator('.pane h2').first().waitFor();
    // Once it stays as it is.
    const settled = async () => {
      for (let before = null, same = 0; ;) {
        const now = await other.evaluate(told);
        same = now === before ? same + 1 : 0;
        if (same === 4) return now;
        before = now;
        await other.waitForTimeout(150);
      }
    };
    const opened = await settled();
    await other.evaluate(() => { location.hash = '#/nowhere'; });
    await other.getByText('No such page').waitFor();
    await other.evaluate((hash) => { location.hash = hash; }, hash);
    if (hash !== '#/') await other.locator('.pane h2').first().waitFor();
    assert.equal(opened, await settled(), hash);
    await other.close();
  }
});

test('a page that was just opened leads to the diagram of its arms, and has policies compared', { timeout: 60_000 }, async () => {
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

test('nothing so far was an error in the console', () => {
  assert.deepEqual(chromium.errors.filter((text) => !/ 422 |409 |ERR_CONNECTION_REFUSED|WebSocket/.test(text)), []);
});
