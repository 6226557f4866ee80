// How quick the dashboard is: pictures a second of the 3D view, tasks of the page that took long, how long
// clicks take, and whether its memory grows, with two arms under the demo load. For an idle machine; a
// test it is not.
//
//   node test/browser/measure.mjs [--seconds N] [--jobs N] [--minutes N]
//
//   --seconds N   how long pictures are counted, default 30
//   --jobs N      so many cancelled jobs are in the history, default 0
//   --minutes N   then so long its memory is watched, default 0

import { spawn } from 'node:child_process';
import { parseArgs } from 'node:util';
import { Browser, job_through, kRoot, Server } from './harness.mjs';

const kLooks = 6;
const kClicks = 12;
const kBatch = 200;
const kLong_ms = 100;
const kEachMinute_ms = 60_000;

const { values } = parseArgs({ options: { seconds: { type: 'string' }, jobs: { type: 'string' }, minutes: { type: 'string' } } });
const [seconds, jobs, minutes] = [Number(values.seconds ?? 30), Number(values.jobs ?? 0), Number(values.minutes ?? 0)];
const server = new Server('config/two_pandas.json', 'coordinated');
const browser = new Browser();
let load;
try {
  const url = await server.start();
  const page = await browser.open({ viewport: { width: 1280, height: 720 } });
  await browser.visit(url);
  if (jobs > 0) await fill_history(page, url, jobs);
  load = spawn('python3', ['server/demo.py', url.replace(/\/$/, ''), 'config/two_pandas_jobs.json'], { cwd: kRoot, stdio: 'ignore' });
  await page.waitForFunction(() => window.armloom.jobs().some(({ state }) => state === 'running'));
  await watch_tasks(page);
  await count_pictures(page);
  await click_about(page);
  await tell_tasks(page);
  if (minutes > 0) await watch_memory(page);
} finally {
  load?.kill();
  await browser.close();
  await server.end();
}

/** Jobs that are told of, wait, and are cancelled: the quickest way to have many. */
async function fill_history(page, url, count) {
  const { names, q } = await page.evaluate(() => {
    const all = window.armloom.q();
    const names = Object.keys(all).filter((name) => name.startsWith('left_panda_joint')).sort();
    return { names, q: names.map((name) => all[name]) };
  });
  const away = q.map((value, i) => (i === 0 ? value + 0.3 : value));
  const ask = async (method, path, body) => {
    const answer = await fetch(`${url}api/v1${path}`, { method, headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) });
    if (!answer.ok) throw new Error(`${method} ${path}: ${answer.status} ${(await answer.text()).slice(0, 300)}`);
  };
  await ask('POST', '/stop');
  for (let from = 0; from < count; from += kBatch) {
    const ids = Array.from({ length: Math.min(kBatch, count - from) }, (_, i) => `past-${from + i}`);
    await ask('POST', '/batches', { atomic: true, jobs: ids.map((id) => job_through(id, names, [q, away, q], 1)) });
    for (const id of ids) await ask('DELETE', `/jobs/${id}`);
    // One that falls behind is told anew how things stand, with the last jobs only.
    await page.waitForFunction((count) => window.armloom.jobs().filter(({ result }) => result !== null).length >= count, from + ids.length);
  }
  await ask('POST', '/resume');
  console.log(`${count} jobs in the history`);
}

async function watch_tasks(page) {
  await page.evaluate(() => {
    window.long_frames = [];
    new PerformanceObserver((list) => window.long_frames.push(...list.getEntries())).observe({ type: 'long-animation-frame' });
  });
}

/** Scripts that took long, by what called them, and frames of which scripts are but a part. */
async function tell_tasks(page) {
  const found = await page.evaluate((long_ms) => window.long_frames.filter(({ duration }) => duration > long_ms).map((frame) => {
    const scripts = frame.scripts.map(({ invoker, sourceURL, sourceFunctionName, duration }) => `${invoker} ${sourceURL.replace(/.*\//, '')} ${sourceFunctionName} ${duration.toFixed(0)} ms`);
    return { ms: frame.duration, script_ms: frame.scripts.reduce((sum, { duration }) => sum + duration, 0), words: scripts.join('; ') };
  }), kLong_ms);
  const worst = found.sort((a, b) => b.script_ms - a.script_ms).slice(0, 5);
  console.log(`${found.length} frames above ${kLong_ms} ms${worst.map(({ ms, script_ms, words }) => `\n  ${ms.toFixed(0)} ms, scripts ${script_ms.toFixed(0)} ms: ${words}`).join('')}`);
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

/** From the click until what it led to is on the page. */
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

/** What is in use after a collection, each minute; the slope is that of the last two thirds, when its books are full. */
async function watch_memory(page) {
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
