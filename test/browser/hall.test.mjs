// Eight Pandas side by side with two hundred waiting jobs: labels do not overlap, every arm has a
// lane and a card, and the lists stay short.
//
//   node --test test/browser/hall.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { ask, counts, eventually, go_to, job_through, kRoot, path_for, reads, with_dashboard } from './harness.mjs';

const kArms = 8;
const kJobsOfEach = 26;
const kHome = [0, -1.2, 0, -2.6, 0, 1.6, 0.785];
const kLeastLane_px = 20;

const folder = mkdtempSync(join(tmpdir(), 'armloom-hall-'));
writeFileSync(join(folder, 'hall.json'), JSON.stringify(hall()));
let page;
const { chromium } = with_dashboard(join(folder, 'hall.json'), 'coordinated', { more: ['--speed', '0.25'] }, (opened) => { ({ page } = opened); });
after(() => rmSync(folder, { recursive: true, force: true }));

/** Returns a cell of eight arms. Neighbors are 0.8 m apart, so their workspaces overlap. */
function hall() {
  const robots = Array.from({ length: kArms }, (_, i) => ({
    name: `arm${i}`, urdf: join(kRoot, 'models/panda.urdf'), srdf: join(kRoot, 'models/panda.srdf'), prefix: `arm${i}_`,
    base: { xyz: [0.8 * (i - (kArms - 1) / 2), 0, 0.1], rpy: [0, 0, Math.PI / 2] },
    arms: [{ name: `arm${i}`, group: 'panda_arm', home: kHome }],
    controller: { type: 'sim', lag_s: 0.02, noise_rad: 0 },
  }));
  const table = { name: 'table', box: [0.8 * kArms + 1, 1.6, 0.1], xyz: [0, 0.4, 0.05], rpy: [0, 0, 0] };
  const scheduling = { policy: 'coordinated', backlog_timeout_s: 600, aging_s: 30, on_idle_blocker: 'park' };
  return { name: 'hall', robots, objects: [table], clearance_m: 0.02, scheduling };
}

/** Returns jobs that move the arm back and forth, alternating sides. */
function jobs_of(arm) {
  const names = Array.from({ length: 7 }, (_, i) => `arm${arm}_panda_joint${i + 1}`);
  const there = (k) => [((k / 2 + arm) % 2 < 1 ? -1 : 1) * 1.2, 0.2, 0, -1.9, 0, 2.1, 0.785];
  return Array.from({ length: kJobsOfEach }, (_, k) => {
    const way = k % 2 === 0 ? [kHome, there(k)] : [there(k - 1), kHome];
    return job_through(`arm${arm}-${k}`, names, way, 4, { name: k % 2 === 0 ? 'fetch' : 'bring' });
  });
}

test('Eight arms and two hundred waiting jobs stay legible', { timeout: 400_000 }, async () => {
  const lists = Array.from({ length: kArms }, (_, arm) => jobs_of(arm));
  const jobs = lists[0].flatMap((_, k) => lists.map((list) => list[k]));
  const { status, value } = await ask(page, 'POST', '/batches', { atomic: true, jobs });
  assert.equal(status, 202, JSON.stringify(value).slice(0, 500));
  await page.waitForFunction((least) => window.armloom.jobs().filter(({ state }) => state !== 'running').length >= least, kArms * (kJobsOfEach - 1));
  await page.waitForFunction(() => window.armloom.lanes().every(({ marks }) => marks.length > 0));
  await page.evaluate(() => window.armloom.drawn());

  const covered = () => page.evaluate(() => {
    const boxes = [...document.querySelectorAll('.arm-label')].map((label) => label.getBoundingClientRect());
    const overlap = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 2 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 2;
    return boxes.flatMap((a, i) => boxes.slice(i + 1).filter((b) => overlap(a, b))).length;
  });
  await eventually(async () => assert.equal(await covered(), 0, 'labels cover each other'));
  await counts(page.locator('.card'), kArms);
  const lanes_px = (await page.locator('.timeline canvas').boundingBox()).height - 18;
  assert.ok(lanes_px / kArms >= kLeastLane_px, `a lane is ${(lanes_px / kArms).toFixed(1)} px high`);
  await eventually(async () => {
    const rows = await page.locator('.job').count();
    assert.ok(rows > 2 * kArms && rows < 140, `${rows} rows are drawn`);
  });
  await counts(page.locator('[data-test^=lane-text-arm]'), kArms);

  await page.screenshot(path_for('hall-dark'));
  await page.locator('[data-test=filter]').fill('arm3');
  await reads(page.locator('[data-test^=count-]').first(), /^\d+ of \d+$/);
  await go_to(page, '#/settings');
  await page.getByLabel('Light', { exact: true }).check();
  await go_to(page, '#/arm/arm3');
  await page.locator('[data-test=page-arm] .uplot').waitFor();
  await page.evaluate(() => window.armloom.drawn());
  await page.screenshot(path_for('hall-light'));

  // An arm whose next job has to let others pass first says for which job, and since when it rests.
  await ask(page, 'PUT', '/sim/speed', { speed: 3 });
  await go_to(page, '#/');
  const waits = page.locator('[data-test=arm-waits]', { hasText: /behind arm\d-\d+ \(\d+ jobs?\), at rest \d+ / }).first();
  await waits.waitFor();
  const first = /arm\d-\d+/.exec(await waits.innerText())[0];
  assert.match(await waits.locator('[data-test=arm-waits-for]').getAttribute('href'), new RegExp(`#/job/${first.slice(0, 5)}`));
  await page.locator('.card [data-test=starves]').first().waitFor();
  await page.screenshot(path_for('hall-waits'));
  assert.deepEqual(chromium.errors, []);
});
