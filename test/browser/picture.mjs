// Makes the picture of a job's page in web/README.md: two Pandas under the demo load, one waiting for the other.
//
//   node test/browser/picture.mjs [FILE]      default web/dashboard-job.png

import { spawn } from 'node:child_process';
import { join, resolve } from 'node:path';
import { Browser, go_to, kRoot, Server } from './harness.mjs';

const file = resolve(process.argv[2] ?? join(kRoot, 'web/dashboard-job.png'));
const server = new Server('config/two_pandas.json', 'coordinated');
const browser = new Browser();
let load;
try {
  const url = await server.start();
  load = spawn('python3', ['server/demo.py', url.replace(/\/$/, ''), 'config/two_pandas_jobs.json'], { cwd: kRoot, stdio: 'ignore' });
  const page = await browser.open({ colorScheme: 'dark' });
  await browser.visit(`${url}?fine#/`);
  const waits = (least_s) => page.waitForFunction((least_s) => {
    const lanes = window.armloom.lanes();
    const long = ({ expected, kind, waits_on, from_s, to_s }) => expected && kind !== 'motion' && waits_on?.arm && to_s - from_s > least_s;
    return lanes.some(({ marks }) => marks.some(({ expected, from_s }) => !expected && from_s > 20)) && lanes.some(({ marks }) => marks.some(long));
  }, least_s, { timeout: 120_000 });
  await waits(0.4);
  const waiting = await page.evaluate(() => window.armloom.lanes().flatMap(({ marks }) => marks).find(({ expected, kind, waits_on }) => expected && kind !== 'motion' && waits_on?.arm)?.job);
  await go_to(page, '#/settings');
  await page.getByLabel('Light', { exact: true }).check();
  await page.evaluate((id) => { location.hash = `#/job/${id}`; }, waiting);
  await page.locator('.uplot').waitFor({ timeout: 60_000 });
  await page.evaluate(() => window.armloom.drawn());
  await page.screenshot({ path: file });
} finally {
  load?.kill();
  await browser.close();
  await server.end();
}
