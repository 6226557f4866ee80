// Makes the README's animated picture of its example: the bar in the left hand blocks the right arm's job, which says why.
//
//   node test/browser/film.mjs [FILE]      default web/blocked.webp; needs img2webp (apt-get install webp)

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { ask, Browser, kRoot, Server } from './harness.mjs';

const kFrame_s = 0.2;   // time between two frames, in the cell and in the picture
const kSpeed = 0.1;  // speed of the cell, so that each frame has two seconds to be drawn
const kBegin_s = 4.5;   // the left arm has the bar
const kMeet_s = 6;      // the job `meet` is posted
const kMost = 70;       // frames
const kBytesMax = 3 << 20;

const file = resolve(process.argv[2] ?? join(kRoot, 'web/blocked.webp'));
const folder = mkdtempSync(join(tmpdir(), 'armloom-film-'));
const server = new Server('config/pick_and_place.json', 'earliest_start', ['--speed', String(kSpeed)]);
const browser = new Browser();
const example = readFileSync(join(kRoot, 'README.md'), 'utf8').split('## Example: ')[1].split('\n## ')[0];
const [show, meet] = [...example.matchAll(/-d '(\{[^']*\})'/g)].map(([, body]) => JSON.parse(body));

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
  await ask(page, 'POST', '/jobs', show);
  const begun_s = await now_s();
  const passed = async (s) => page.waitForTimeout(Math.max(0, (begun_s + s - await now_s()) / kSpeed * 1000));
  let is_posted = false;
  for (let is_done = false; !is_done && frames.length < kMost;) {
    const at_s = kBegin_s + frames.length * kFrame_s;
    await passed(at_s);
    if (at_s >= kMeet_s && !is_posted) is_posted = (await ask(page, 'POST', '/jobs', meet)).status === 202;
    await shoot();
    is_done = is_posted && (await ask(page, 'GET', '/jobs/meet')).value.progress > 0.9;
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
