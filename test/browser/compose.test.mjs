// Composing jobs as a user does. Checks and previews jobs before sending them, drops files, copies
// jobs for programs, plans goals by form and in the 3D view, and cancels jobs.
//
//   node --test test/browser/compose.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { arm_now, ask, copied_by, drop_files, eventually, finished, go_to, job_through, looks_different, path_for, reads, run, send_through, view_picture, with_dashboard } from './harness.mjs';

const kMiddle = [0, -0.7, 0, -1.8, 0, 2.6, 0];
const kLeastShown_px = 1500;
const kLeastGhost_px = 800;
// A job name that a shell or a page would misinterpret if it were not quoted.
const kHostile = `<img src=x onerror="window.was_html=1"><b>&amp;'$(exit 3)`;

const folder = mkdtempSync(join(tmpdir(), 'armloom-compose-'));
let page;
const { chromium } = with_dashboard('config/two_pandas.json', 'coordinated', {}, (opened) => { ({ page } = opened); });
after(() => rmSync(folder, { recursive: true, force: true }));

const go = (hash) => go_to(page, hash);
const send = (...job) => send_through(page, ...job);
const ended = (id) => finished(page, id);
const holds = (field, pattern) => eventually(async () => assert.match(await field.inputValue(), pattern));

test('New job page checks a job before sending, and accepts a batch as a whole', { timeout: 300_000 }, async () => {
  await page.locator('[data-test=new-job]').click();
  const { names, q } = await arm_now(page, 'left');
  const text = page.locator('[data-test=job-text]');
  await text.fill(JSON.stringify(job_through('judged', names, [q, kMiddle, q], 4)));
  await page.locator('[data-test=check-job]').click();
  await reads(page.locator('[data-test=check-results]'), /free\s+It would start now/);
  assert.equal((await ask(page, 'GET', '/jobs/judged')).status, 404);

  // The preview shows a ghost of the arm, also at the time of the conflict.
  const without = await view_picture(page);
  await page.locator('[data-test=preview-time]').fill('4');
  await looks_different(page, without, kLeastShown_px);
  await ask(page, 'PUT', '/scene/objects/post', { box: [0.1, 0.1, 0.6], xyz: [-0.05, 0, 0.6], rpy: [0, 0, 0] });
  await page.locator('[data-test=check-job]').click();
  await page.locator('[data-test=show-conflict]').first().click();
  await reads(page.locator('[data-test=check-results]'), /in conflict/);
  await page.waitForFunction(() => { const at = Number(document.querySelector('[data-test=preview-time]').value); return at > 0.1 && at < 3.9; });
  await page.evaluate(() => window.armloom.drawn());
  await page.screenshot(path_for('preview-dark'));
  await ask(page, 'DELETE', '/scene/objects/post');
  const bag = [1, 2].map((i) => ({ at: 0, job: job_through(`bag-${i}`, names, [q, q.map((v, k) => v + (k === 0 ? 0.1 * i : 0)), q], 1) }));
  await text.fill(JSON.stringify(bag));
  await reads(page.locator('[data-test=batch]'), /2 jobs/);
  await page.screenshot(path_for('compose-dark'));
  await page.locator('[data-test=send]').click();
  await page.locator('[data-test=accepted]').getByText('bag-2').click();
  await page.locator('[data-test=page-job]').getByText('bag-2').first().waitFor();
  await page.locator('[data-test=list-finished] [data-test="job-bag-2"]').waitFor();
});

test('A job file dropped anywhere on the page is shown and can be sent', { timeout: 300_000 }, async () => {
  await go('#/');
  const { names, q } = await arm_now(page, 'left');
  const way = [q, q.map((v, k) => v + (k === 0 ? -0.3 : 0))];
  const { trajectory } = job_through('', names, way, 1);
  const file = join(folder, 'trajectory.json');
  writeFileSync(file, JSON.stringify(trajectory));  // a bare trajectory, as ROS tools write it, without a job around it
  await drop_files(page, [file], '.view canvas');
  await page.locator('[data-test=page-new]').waitFor();
  await eventually(async () => assert.equal(await page.locator('[data-test=job-text]').inputValue(), JSON.stringify(trajectory)));
  await page.locator('[data-test=preview-time]').waitFor();
  await page.locator('[data-test=check-job]').click();
  await page.locator('[data-test=check-results]', { hasText: 'free' }).waitFor();
  await page.locator('[data-test=send]').click();
  const id = await page.locator('[data-test=accepted] a').innerText();
  await page.locator(`[data-test=list-finished] [data-test="job-${id}"][data-state=succeeded]`).waitFor();
});

test('Copied curl and Python snippets of requests and jobs work', { timeout: 400_000 }, async () => {
  const { names, q } = await arm_now(page, 'right');
  const copy = (what) => page.locator(`.pane [data-test=copy-${what}]`);
  for (const [what, program] of [['curl', ['bash', '-c']], ['Python', ['python3', '-c']]]) {
    const id = `by-${what}`;
    await go('#/new');
    await page.locator('[data-test=job-text]').fill(JSON.stringify(job_through(id, names, [q, q], 1, { name: kHostile }), null, 1));
    assert.match(await run(program[0], [program[1], await copied_by(page, copy(what))]), new RegExp(`\\Wid\\W+${id}\\W`));
    await page.locator(`[data-test=list-finished] [data-test="job-${id}"][data-state=succeeded]`).waitFor();
    await go(`#/job/${id}`);
    await page.locator('[data-test=page-job] [data-test=raw]', { hasText: id }).waitFor();
    const told = await run(program[0], [program[1], await copied_by(page, copy(what))]);
    if (what === 'curl') assert.equal(JSON.parse(told).name, kHostile);
    else assert.equal(told.trim(), 'succeeded []');
    assert.equal(JSON.parse(await copied_by(page, copy('JSON'))).id, id);
  }
});

test('Cancel asks for confirmation', { timeout: 300_000 }, async () => {
  await ask(page, 'PUT', '/sim/speed', { speed: 0.1 });  // slow, so that a busy machine keeps up
  await send('left', 'unwanted', [kMiddle, null], 5);
  const row = page.locator('[data-test="job-unwanted"]');
  await row.getByRole('button', { name: 'Cancel unwanted' }).click();
  await row.getByRole('button', { name: 'Keep' }).click();
  // The button Keep returns the focus to the button that asked.
  const focused = () => page.evaluate(() => document.activeElement?.getAttribute('aria-label'));
  await eventually(async () => assert.equal(await focused(), 'Cancel unwanted'));
  await page.keyboard.press('Enter');
  await row.locator('[data-test=confirm-cancel]').waitFor();
  await page.keyboard.press('Escape');
  await eventually(async () => assert.equal(await focused(), 'Cancel unwanted'));
  assert.match(await row.getAttribute('data-state'), /queued|running|scheduled/);
  await row.getByRole('button', { name: 'Cancel unwanted' }).click();
  await row.locator('[data-test=confirm-cancel]').click();
  await ask(page, 'PUT', '/sim/speed', { speed: 1 });
  await page.locator('[data-test=list-finished] [data-test="job-unwanted"]').waitFor();
  await page.locator('[data-test="job-unwanted"][data-state=canceled]').waitFor();
  await page.locator('[data-test=filter]').fill('canceled left');
  await page.locator('[data-test="job-by-curl"]').waitFor({ state: 'detached' });
  await page.locator('[data-test="job-unwanted"]').waitFor();
  await page.locator('[data-test=filter]').fill('');
});

test('Plan form plans, previews and sends a path to a goal', { timeout: 400_000 }, async () => {
  await page.locator('[data-test=new-job]').click();
  await page.locator('[data-test=plan-goal] summary').click();
  await page.locator('[data-test=plan-arm]').selectOption('left');
  await page.locator('[data-test=plan-kind]').selectOption('pose');
  await page.locator('[data-test=plan-xyz]').fill('0, 9, 0.5');
  await page.locator('[data-test=plan]').click();
  await page.locator('[data-test=plan-form] [data-test=problem]').waitFor();
  await page.locator('[data-test=plan-xyz]').fill('zero');
  await page.locator('[data-test=plan]').click();
  await reads(page.locator('[data-test=plan-fault]'), /Position.*zero/);
  const before = await view_picture(page);
  await page.locator('[data-test=plan-kind]').selectOption('named');
  await page.locator('[data-test=plan-named]').selectOption('ready');
  await page.locator('[data-test=plan]').click();
  await page.locator('[data-test=planned]').waitFor();
  await reads(page.locator('[data-test=planned]'), /certified.*could start now/);
  await holds(page.locator('[data-test=job-text]'), /left to ready[^]*left_panda_joint1/);
  await looks_different(page, before, kLeastGhost_px, 'pixels of ghosts');
  await page.screenshot(path_for('plan-dark'));
  await page.locator('[data-test=send]').click();
  const id = await page.locator('[data-test=accepted] a').innerText();
  await ended(id);
});

test('A pasted goal is planned and previewed before sending', { timeout: 400_000 }, async () => {
  await page.locator('[data-test=new-job]').click();
  const ghost = () => page.evaluate(() => window.armloom.ghost());
  const text = page.locator('[data-test=job-text]');
  await text.fill(JSON.stringify({ id: 'by-goal', arm: 'right', move_to: { named: 'ready' } }));
  await page.locator('[data-test=goal-path]', { hasText: 'as planned now' }).waitFor();
  const end = await eventually(async () => {
    const shown = await ghost();
    assert.ok(Object.keys(shown ?? {}).some((joint) => joint.startsWith('right_')), 'the arm stands at its goal, as a ghost');
    return shown;
  });
  await page.locator('[data-test=preview-time]').fill('0');
  await eventually(async () => assert.notDeepEqual(await ghost(), end));
  await page.screenshot(path_for('compose-goal'));
  // An incomplete goal sends no request; an unreachable goal shows a problem.
  await text.fill(JSON.stringify({ arm: 'right', move_to: { named: 'rea' } }));
  await page.locator('[data-test=goal-path]').waitFor({ state: 'detached' });
  await text.fill(JSON.stringify({ arm: 'right', move_to: { pose: { xyz: [3, 0, 0.5] } } }));
  await page.locator('[data-test=goal-problem]').waitFor();
  await text.fill('');
});

test('A tool goal dragged in the 3D view is planned and previewed before sending', { timeout: 400_000 }, async () => {
  await go('#/');
  await page.locator('[data-test=new-job]').click();
  await page.locator('[data-test=plan-goal] summary').click();
  await page.locator('[data-test=plan-arm]').selectOption('right');
  await page.locator('[data-test=plan-kind]').selectOption('pose');
  await page.locator('[data-test=plan-xyz]').fill('');
  await page.locator('[data-test=plan-move]').click();
  await page.waitForFunction(() => window.armloom.where_is_tool() !== null);
  const before = await view_picture(page);
  const view = await page.locator('.view canvas').boundingBox();
  const tool = await page.evaluate(() => window.armloom.where_is_tool());
  await page.mouse.move(view.x + tool.x, view.y + tool.y);
  await page.mouse.down();
  await page.mouse.move(view.x + tool.x + 20, view.y + tool.y - 20, { steps: 6 });
  await page.mouse.up();
  await page.locator('[data-test=planned]').waitFor();
  await reads(page.locator('[data-test=planned]'), /certified.*could start now/);
  await holds(page.locator('[data-test=plan-xyz]'), /^-?[\d.]+, -?[\d.]+, -?[\d.]+$/);
  await holds(page.locator('[data-test=job-text]'), /right_panda_joint1/);
  await looks_different(page, before, kLeastGhost_px, 'pixels of ghosts');
  const { status, value } = await ask(page, 'GET', '/jobs?arm=right&state=running');
  assert.equal(status, 200);
  assert.deepEqual(value.jobs, [], 'nothing moves before it is sent');
  await page.locator('[data-test=plan-turn]').click();
  await page.locator('[data-test=plan-move][aria-pressed=false]').waitFor();
  await page.screenshot(path_for('drag-tool-dark'));
  await page.locator('[data-test=send]').click();
  await ended(await page.locator('[data-test=accepted] a').innerText());
});

test('The console has no errors', () => {
  assert.deepEqual(chromium.errors.filter((text) => !/404 \(.*\/jobs\/judged$|422 \(.*\/plan$/.test(text)), []);
});
