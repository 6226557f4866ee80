// Measures the dashboard's performance with two arms under the demo load: frames per second, long
// tasks, response of clicks and of the timeline, memory growth. Needs an idle machine; not a test.
//
//   node test/browser/measure.mjs [--seconds N] [--jobs N] [--busy N] [--minutes N]
//
//   --seconds N   how long frames are counted, default 30; 0 also skips clicks and timeline
//   --jobs N      number of finished jobs before, default 0
//   --busy N      number of busy programs running alongside, default 0
//   --minutes N   then how long memory is watched, in a small window, default 0

import { spawn } from 'node:child_process';
import { parseArgs } from 'node:util';
import { arm_now, Browser, job_through, kRoot, Server } from './harness.mjs';

const kLooks = 6;
const kClicks = 12;
const kBatch = 200;  // a multiple of four, so that each arm ends at its start
const kHaste = 20;
const kSwing_rad = 0.2;
const kDragged_px = 400;
const kSteps = 40;
const kZooms = 12;
const kSmall = { width: 800, height: 600 };
const kLong_ms = 100;
const kEachMinute_ms = 60_000;

const kOptions = { seconds: 30, jobs: 0, busy: 0, minutes: 0 };
const { values } = parseArgs({ options: Object.fromEntries(Object.keys(kOptions).map((name) => [name, { type: 'string' }])) });
const { seconds, jobs, busy, minutes } = Object.fromEntries(Object.entries(kOptions).map(([name, usual]) => [name, Number(values[name] ?? usual)]));
const server = new Server('config/two_pandas.json', 'coordinated');
const browser = new Browser();
const others = [];
try {
  const url = await server.start();
  const page = await browser.open({ viewport: { width: 1280, height: 720 } });
  await browser.visit(url);
  if (jobs > 0) await fill_history(page, url, jobs);
  others.push(spawn('python3', ['server/demo.py', url.replace(/\/$/, ''), 'config/two_pandas_jobs.json'], { cwd: kRoot, stdio: 'ignore' }));
  await page.waitForFunction(() => window.armloom.jobs().some(({ state }) => state === 'running'));
  for (let i = 0; i < busy; i++) others.push(spawn(process.execPath, ['-e', 'for (;;);'], { stdio: 'ignore' }));
  if (seconds > 0) {
    await watch_tasks(page);
    await count_pictures(page);
    await tell_tasks(page, 'while nobody did anything');
    await click_about(page);
    await tell_tasks(page, 'of clicks');
    await use_timeline(page);
    await tell_tasks(page, 'of the timeline');
  }
  if (minutes > 0) await watch_memory(page);
} finally {
  for (const other of others) other.kill('SIGKILL');
  await browser.close();
  await server.end();
}

/** Runs `count` short jobs, alternating between both arms and back and forth. */
async function fill_history(page, url, count) {
  const arms = await Promise.all(['left', 'right'].map((arm) => arm_now(page, arm)));
  const call = async (method, path, body) => {
    const answer = await fetch(`${url}api/v1${path}`, { method, headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) });
    if (!answer.ok) throw new Error(`${method} ${path}: ${answer.status} ${(await answer.text()).slice(0, 300)}`);
  };
  await call('PUT', '/sim/speed', { speed: kHaste });
  for (let from = 0; from < count; from += kBatch) {
    const batch = Array.from({ length: Math.min(kBatch, count - from) }, (_, i) => {
      const { names, q } = arms[i % 2];
      const away = q.map((angle, k) => (k === 6 ? angle + kSwing_rad : angle));
      return job_through(`past-${from + i}`, names, (i >> 1) % 2 === 0 ? [q, away] : [away, q], 1);
    });
    await call('POST', '/batches', { atomic: true, jobs: batch });
    // Waits for the page. If the page falls behind, it gets a new snapshot, which has only the last
    // jobs.
    await page.waitForFunction((count) => window.armloom.jobs().filter(({ result }) => result !== null).length >= count, from + batch.length, { timeout: 600_000, polling: 200 });
  }
  await call('PUT', '/sim/speed', { speed: 1 });
  console.log(`${count} jobs in the history`);
}

async function watch_tasks(page) {
  await page.evaluate(() => {
    window.long_frames = [];
    new PerformanceObserver((list) => window.long_frames.push(...list.getEntries())).observe({ type: 'long-animation-frame' });
  });
}

/** Prints slow scripts by their callers, and slow frames. */
async function tell_tasks(page, when) {
  const found = await page.evaluate((long_ms) => window.long_frames.splice(0).filter(({ duration }) => duration > long_ms).map((frame) => {
    const scripts = frame.scripts.map(({ invoker, sourceURL, sourceFunctionName, duration }) => `${invoker} ${sourceURL.replace(/.*\//, '')} ${sourceFunctionName} ${duration.toFixed(0)} ms`);
    return { ms: frame.duration, script_ms: frame.scripts.reduce((sum, { duration }) => sum + duration, 0), words: scripts.join('; ') };
  }), kLong_ms);
  const worst = found.sort((a, b) => b.script_ms - a.script_ms).slice(0, 5);
  console.log(`${found.length} frames above ${kLong_ms} ms ${when}${worst.map(({ ms, script_ms, words }) => `\n  ${ms.toFixed(0)} ms, scripts ${script_ms.toFixed(0)} ms: ${words}`).join('')}`);
}

async function count_pictures(page) {
  const look = () => page.evaluate(() => [performance.now(), window.armloom.pictures(), JSON.stringify(window.armloom.level())]);
  for (let i = 0; i < kLooks; i++) {
    const before = await look();
    await page.waitForTimeout((1000 * seconds) / kLooks);
    const after = await look();
    console.log(`${((after[1] - before[1]) / ((after[0] - before[0]) / 1000)).toFixed(1)} pictures a second, ${after[2]}`);
  }
}

/** Clicks on links and measures the time from each click until its page is shown. */
async function click_about(page) {
  const places = ['#/history', '#/settings', '#/recordings', '#/'];
  const took = [];
  for (let i = 0; i < kClicks; i++) {
    const place = places[i % places.length];
    took.push([place, await page.evaluate((place) => new Promise((done) => {
      const from_ms = performance.now();
      document.querySelector(`nav a[href="${place}"], nav a[href^="${place}?"]`).click();
      const look = () => {
        const pane = document.querySelector('.pane');
        if (place === '#/' ? pane : !pane?.matches(`[data-test="page-${place.slice(2)}"]`)) requestAnimationFrame(look);
        else requestAnimationFrame(() => setTimeout(() => done(performance.now() - from_ms)));
      };
      look();
    }), place)]);
    await page.waitForTimeout(200);
  }
  const [place, most_ms] = took.sort((a, b) => b[1] - a[1])[0];
  console.log(`clicks answered in ${most_ms.toFixed(0)} ms at most (${place}), ${took[kClicks >> 1][1].toFixed(0)} ms in the middle`);
}

/**
 * Drags and zooms the timeline, at its default length and at its full length. Measures from each
 * event until it is drawn.
 */
async function use_timeline(page) {
  for (const what of ['a minute', 'all that was']) {
    if (what === 'all that was') for (let i = 0; i < kZooms; i++) await page.getByRole('button', { name: 'Zoom out' }).click();
    const took = await page.evaluate(async ([steps, dragged_px]) => {
      const canvas = document.querySelector('.timeline canvas');
      const { left, top, width } = canvas.getBoundingClientRect();
      const drawn = () => new Promise((done) => { requestAnimationFrame(() => setTimeout(done)); });
      const took = [];
      const send = async (event) => {
        const from_ms = performance.now();
        canvas.dispatchEvent(event);
        await drawn();
        took.push(performance.now() - from_ms);
      };
      canvas.setPointerCapture = () => {};  // synthetic pointers cannot be captured
      const at = (dx) => ({ bubbles: true, cancelable: true, pointerId: 1, clientX: left + width / 2 + dx, clientY: top + 20 });
      for (const way of [1, -1]) {
        await send(new PointerEvent('pointerdown', at(0)));
        for (let i = 1; i <= steps; i++) await send(new PointerEvent('pointermove', at((way * dragged_px * i) / steps)));
        await send(new PointerEvent('pointerup', at(way * dragged_px)));
      }
      for (let i = 0; i < steps; i++) await send(new WheelEvent('wheel', { ...at(0), deltaY: i % 2 === 0 ? 100 : -100 }));
      return took.sort((a, b) => a - b);
    }, [kSteps, kDragged_px]);
    const shown = await page.evaluate(() => window.armloom.lanes().reduce((sum, { marks }) => sum + marks.length, 0));
    console.log(`the timeline with ${what} (${shown} marks known): drags and turns of the wheel drawn in ${took.at(-1).toFixed(0)} ms at most, ${took[took.length >> 1].toFixed(0)} ms in the middle`);
  }
}

/**
 * Prints the used memory each minute, after a garbage collection. The slope is computed from the
 * last two thirds of the time, when the page's buffers are full.
 */
async function watch_memory(page) {
  await page.setViewportSize(kSmall);
  const session = await page.context().newCDPSession(page);
  const heaps = [];
  for (let minute = 0; minute <= minutes; minute++) {
    await session.send('HeapProfiler.collectGarbage');
    const { usedSize } = await session.send('Runtime.getHeapUsage');
    const { nodes, listeners } = await session.send('Memory.getDOMCounters').then(({ nodes, jsEventListeners }) => ({ nodes, listeners: jsEventListeners }));
    const finished = await page.evaluate(() => window.armloom.jobs().length);
    heaps.push([minute, usedSize / 1e6]);
    console.log(`${minute} min: heap ${(usedSize / 1e6).toFixed(2)} MB, ${nodes} nodes, ${listeners} listeners, ${finished} jobs known`);
    if (minute < minutes) await page.waitForTimeout(kEachMinute_ms);
  }
  const last = heaps.slice(Math.floor(heaps.length / 3));
  const [t, m] = [0, 1].map((k) => last.reduce((sum, one) => sum + one[k], 0) / last.length);
  const slope = last.reduce((sum, one) => sum + (one[0] - t) * (one[1] - m), 0) / last.reduce((sum, one) => sum + (one[0] - t) ** 2, 0);
  console.log(`slope ${(60 * slope).toFixed(2)} MB an hour`);
}
