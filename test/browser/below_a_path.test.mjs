// The dashboard below a path of a reverse proxy, which removes the path: every request of the page
// goes through the proxy, below this path.
//
//   node --test test/browser/below_a_path.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import http from 'node:http';
import net from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { address_like, Browser, copied_by, finished, go_to, kBinary, kPatience_ms, run, Server } from './harness.mjs';

const kPath = '/cells/a/';

const folder = mkdtempSync(join(tmpdir(), 'armloom-proxy-'));
const tokens = join(folder, 'tokens');
const token = execFileSync(kBinary, ['token', 'add', '--tokens', tokens, '--name', 'ada', '--role', 'operator'], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }).trim();

const server = new Server('config/two_pandas.json', 'coordinated', ['--tokens', tokens]);
const browser = new Browser();
const outside = [];  // requested paths that are not below kPath
const sockets = new Set();
let proxy;
let page;
let url;

/** Starts a proxy that serves the server below kPath, and nothing else. Returns the proxy's address. */
async function start_proxy(server_url) {
  const { hostname, port } = new URL(server_url);
  const target = (request) => {
    if (request.url.startsWith(kPath)) return request.url.slice(kPath.length - 1);
    outside.push(request.url);
    return null;
  };
  proxy = http.createServer((request, response) => {
    const path = target(request);
    if (path === null) return response.writeHead(404).end();
    const onward = http.request({ hostname, port, path, method: request.method, headers: request.headers }, (answer) => {
      response.writeHead(answer.statusCode, answer.headers);
      answer.pipe(response);
    });
    onward.on('error', () => response.destroy());
    response.on('close', () => onward.destroy());
    request.pipe(onward);
  });
  proxy.on('connection', (socket) => { sockets.add(socket); socket.on('close', () => sockets.delete(socket)); });
  proxy.on('upgrade', (request, socket, head) => {
    const path = target(request);
    if (path === null) return socket.destroy();
    const onward = net.connect(Number(port), hostname, () => {
      const headers = Object.entries(request.headers).map(([name, value]) => `${name}: ${value}`);
      onward.write(`${request.method} ${path} HTTP/1.1\r\n${headers.join('\r\n')}\r\n\r\n`);
      onward.write(head);
      socket.pipe(onward).pipe(socket);
    });
    for (const one of [socket, onward]) one.on('error', () => { socket.destroy(); onward.destroy(); });
  });
  await new Promise((done) => proxy.listen(0, '127.0.0.1', done));
  return `http://127.0.0.1:${proxy.address().port}${kPath}`;
}

before(async () => {
  url = await start_proxy(await server.start());
  page = await browser.open({ colorScheme: 'dark' });
}, { timeout: 2 * kPatience_ms });
after(async () => {
  await browser.close();
  for (const socket of sockets) socket.destroy();
  proxy?.close();
  await server.end();
  rmSync(folder, { recursive: true });
});

test('The page logs in, connects, draws and executes a job below a path', { timeout: 300_000 }, async () => {
  await page.goto(`${url}#/arm/left`);
  await address_like(page, /\/cells\/a\/login#\/arm\/left$/);
  await page.locator('#token').fill(token);
  await page.locator('button').click();
  await address_like(page, /\/cells\/a\/#\/arm\/left$/);
  await page.locator('[data-test=link].open').waitFor();
  await page.waitForFunction(() => window.armloom?.is_drawn());
  await go_to(page, '#/new');
  await page.locator('[data-test=example-left]').click();
  const curl = await copied_by(page, page.locator('.pane [data-test=copy-curl]'));
  const job = JSON.parse(await run('bash', ['-c', curl], { ARMLOOM_TOKEN: token }));
  assert.equal(job.state, 'queued', JSON.stringify(job));
  await finished(page, job.id);
});

test('Earlier events, past positions and the API documentation are read below a path', { timeout: 300_000 }, async () => {
  const asked = [];
  page.on('response', (response) => { if (response.ok()) asked.push(new URL(response.url()).pathname); });
  await page.reload();
  await page.locator('[data-test=link].open').waitFor();
  await page.waitForFunction(() => window.armloom?.is_drawn() && window.armloom.lanes().some(({ marks }) => marks.length > 0));
  for (const path of ['events', 'states', 'timeline', 'cell']) {
    for (let i = 0; i < 100 && !asked.includes(`${kPath}api/v1/${path}`); ++i) await page.waitForTimeout(100);
    assert.ok(asked.includes(`${kPath}api/v1/${path}`), `${path} is not among ${asked.join(' ')}`);
  }
  await page.goto(`${url}docs`);
  await page.locator('text=/jobs/').first().waitFor();
});

test('No request left the path, and the console has no errors', () => {
  assert.deepEqual(outside, []);
  assert.deepEqual(browser.errors.filter((text) => !/401|WebSocket/.test(text)), []);
});
