// How quick the dashboard is: frames a second of the 3D view, the longest task, how long clicks take, and
// what its memory does, with two arms under the demo load. For an idle machine; a test it is not.
//
//   node test/browser/measure.mjs [SECONDS]      default 30

import { spawn } from 'node:child_process';
import { Browser, kRoot, Server } from './harness.mjs';

const kLooks = 6;
const kClicks = 10;

const seconds = Number(process.argv[2] ?? 30);
const server = new Server('config/two_pandas.json', 'coordinated');
const browser = new Browser();
let load;
try {
  const url = await server.start();
  load = spawn('python3', ['server/demo.py', url.replace(/\/$/, ''), 'config/two_pandas_jobs.json'], { cwd: kRoot, stdio: 'ignore' });
  const page = await browser.open({ viewport: { width: 1280, height: 720 } });
  await browser.visit(url);
  const session = await page.context().newCDPSession(page);
  await page.evaluate(() => {
    window.longest_ms = 0;
    new PerformanceObserver((list) => { for (const { duration } of list.getEntries()) window.longest_ms = Math.max(window.longest_ms, duration); }).observe({ type: 'longtask' });
  });
  for (let look = 0; look < kLooks; look++) {
    const before = await page.evaluate(() => [performance.now(), window.armloom.pictures()]);
    await page.waitForTimeout((1000 * seconds) / kLooks);
    const after = await page.evaluate(() => [performance.now(), window.armloom.pictures()]);
    await session.send('HeapProfiler.collectGarbage');
    const heap = await page.evaluate(() => performance.memory.usedJSHeapSize);
    const level = await page.evaluate(() => JSON.stringify(window.armloom.level()));
    console.log(`${((after[1] - before[1]) / ((after[0] - before[0]) / 1000)).toFixed(1)} pictures a second, heap ${(heap / 1e6).toFixed(1)} MB, ${level}`);
  }
  const clicks_ms = [];
  for (let i = 0; i < kClicks; i++) {
    const place = i % 2 === 0 ? '#/history' : '#/settings';
    clicks_ms.push(await page.evaluate((place) => new Promise((done) => {
      const from_ms = performance.now();
      document.querySelector(`nav a[href^="${place}"]`).click();
      requestAnimationFrame(() => setTimeout(() => done(performance.now() - from_ms)));
    }), place));
  }
  console.log(`clicks answered in ${Math.max(...clicks_ms).toFixed(0)} ms at most; longest task ${(await page.evaluate(() => window.longest_ms)).toFixed(0)} ms`);
} finally {
  load?.kill();
  await browser.close();
  await server.end();
}
