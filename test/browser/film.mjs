// Makes the README's animated picture: a job is blocked and says why, the blocking arm retreats, the job starts.
//
//   node test/browser/film.mjs [FILE]      default web/blocked.webp; needs img2webp (apt-get install webp)

import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { ask, Browser, job_through, kRoot, Server } from './harness.mjs';

const kFrame_s = 0.2;   // time between two frames, in the cell and in the picture
const kSpeed = 0.1;  // speed of the cell, so that each frame has two seconds to be drawn
const kMost = 70;       // frames
const kBytesMax = 3 << 20;

const file = resolve(process.argv[2] ?? join(kRoot, 'web/blocked.webp'));
const folder = mkdtempSync(join(tmpdir(), 'armloom-film-'));
const server = new Server('config/two_pandas.json', 'coordinated', ['--speed', String(kSpeed)]);
const browser = new Browser();
const joints = (arm) => [1, 2, 3, 4, 5, 6, 7].map((n) => `${arm}_panda_joint${n}`);
const reach = (id, arm) => job_through(id, joints(arm), [[0, -1.2, 0, -2.6, 0, 1.6, 0.785], [0, -0.4, 0, -1.2, 0, 2.0, 0.785]], 3);

try {
  const url = await server.start();
  const page = await browser.open({ colorScheme: 'dark', viewport: { width: 1120, height: 700 } });
  await browser.visit(`${url}#/`);
  const now_s = async () => (await ask(page, 'GET', '/timeline')).value.now_s;
  const frames = [];
  const shoot = async () => {
    await page.evaluate(() => window.armloom.drawn());
    frames.push(join(folder, `${String(frames.length).padStart(3, '0')}.png`));
    await page.screenshot({ path: frames.at(-1) });
  };
  await shoot();
  for (const job of [reach('reach', 'left'), reach('meet', 'right')]) await ask(page, 'POST', '/jobs', job);
  const begun_s = await now_s();
  for (let is_done = false; !is_done && frames.length < kMost;) {
    const wait_s = begun_s + frames.length * kFrame_s - await now_s();
    await page.waitForTimeout(Math.max(0, wait_s / kSpeed * 1000));
    await shoot();
    is_done = (await ask(page, 'GET', '/jobs/meet')).value.progress > 0.9;
  }
  if (frames.length === kMost) throw new Error('the blocked job did not get near its end');
  const last = Array(8).fill(frames.at(-1));
  execFileSync('img2webp', ['-loop', '0', '-lossy', '-q', '55', '-m', '4', '-d', String(kFrame_s * 1000), ...frames, ...last, '-o', file]);
  const { size } = statSync(file);
  console.log(`${file}: ${frames.length} frames, ${size} bytes`);
  if (size > kBytesMax) throw new Error(`larger than ${kBytesMax} bytes`);
} finally {
  await browser.close();
  await server.end();
  rmSync(folder, { recursive: true, force: true });
}
