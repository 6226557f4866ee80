// Runs the dashboard in a real browser with a real server.
//
//   ARMLOOM_BINARY          the server's binary, default build/armloom
//   ARMLOOM_WEB             the dashboard's files, default: the server's default, web/dist
//   ARMLOOM_CHROMIUM        the browser, default /usr/bin/chromium
//   ARMLOOM_SCREENSHOT_DIR  the folder for screenshots; none are kept without it

import assert from 'node:assert/strict';
import { execFile, spawn } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, afterEach, before } from 'node:test';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { difference } from './pictures.mjs';

export const kRoot = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
export const web_require = createRequire(join(kRoot, 'web/package.json'));
const { chromium } = web_require('playwright-core');

export const kBinary = resolve(process.env.ARMLOOM_BINARY ?? join(kRoot, 'build/armloom'));
const kChromium = process.env.ARMLOOM_CHROMIUM ?? '/usr/bin/chromium';
const kPictures = process.env.ARMLOOM_SCREENSHOT_DIR;
// The defaults of Chromium without a graphics card: WebGL is rendered in software, the page itself
// without a GPU. With `--use-angle=swiftshader` both would use the software GPU, at 15 ms per
// change of the page.
const kFlags = [
  '--use-angle=swiftshader-webgl', '--enable-unsafe-swiftshader', '--no-sandbox', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync',
];
// Time limit for an expected change. A busy machine may take ten times as long as an idle one. Only
// a failing test waits this long.
export const kPatience_ms = 60_000;
const kAgain_ms = 50;

/** A server process for one cell. It can be stopped and restarted at the same address. */
export class Server {
  constructor(cell, policy, more = []) {
    this.arguments_ = ['serve', '--cell', cell, '--policy', policy, ...more];
    if (process.env.ARMLOOM_WEB) this.arguments_.push('--web', resolve(process.env.ARMLOOM_WEB));
    this.listen_ = '127.0.0.1:0';
  }

  /** Starts the server and returns the address that it prints. */
  start() {
    this.output_ = '';
    this.process_ = spawn(kBinary, [...this.arguments_, '--listen', this.listen_], { cwd: kRoot });
    this.process_.on('error', (error) => { this.output_ += String(error); });
    for (const stream of [this.process_.stdout, this.process_.stderr]) stream.on('data', (data) => { this.output_ += data; });
    return new Promise((done, fail) => {
      const lost = () => fail(new Error(`the server did not come up: ${kBinary}\n${this.output_}`));
      const timer = setTimeout(lost, kPatience_ms);
      this.process_.once('exit', lost);
      this.process_.stdout.on('data', () => {
        const [, url, listen] = /dashboard: (http:\/\/(127\.0\.0\.1:\d+)\/)/.exec(this.output_) ?? [];
        if (!url) return;
        clearTimeout(timer);
        this.process_.off('exit', lost);
        this.listen_ = listen;
        done(url);
      });
    });
  }

  /** Suspends the server process: its connections stay open, but it sends nothing. */
  freeze() { this.process_.kill('SIGSTOP'); }
  thaw() { this.process_.kill('SIGCONT'); }

  async end() {
    const server = this.process_;
    if (!server?.pid || server.exitCode !== null || server.signalCode !== null) return;
    const ended = new Promise((done) => server.once('exit', done));
    server.kill('SIGTERM');
    const hard = setTimeout(() => server.kill('SIGKILL'), 5000);
    await ended;
    clearTimeout(hard);
  }
}

/** A browser with its own profile; `errors` collects console errors. */
export class Browser {
  errors = [];

  async open(options = {}) {
    this.profile_ = mkdtempSync(join(tmpdir(), 'armloom-browser-'));
    this.context = await chromium.launchPersistentContext(this.profile_, {
      executablePath: kChromium, args: kFlags, viewport: { width: 1440, height: 900 }, ...options,
    });
    this.context.setDefaultTimeout(kPatience_ms);
    this.page = this.context.pages()[0] ?? await this.context.newPage();
    this.page.on('console', (message) => { if (message.type() === 'error') this.errors.push(`${message.text()} ${message.location().url}`); });
    this.page.on('pageerror', (error) => this.errors.push(String(error)));
    return this.page;
  }

  /** Opens the dashboard and waits until it is connected and drawn. */
  async visit(url) {
    await this.page.goto(url);
    await this.page.locator('[data-test=link].open').waitFor();
    await this.page.waitForFunction(() => window.armloom?.is_drawn());
  }

  async close() {
    await this.context?.close();
    if (this.profile_) rmSync(this.profile_, { recursive: true, force: true });
  }
}

/**
 * Starts a server and a browser before the tests of a suite, and stops them afterwards. Calls
 * `opened` with both, the page and its address. `more` are arguments for the server. `visits` must
 * be false if the page requires a login. Other options go to the browser.
 */
export function with_dashboard(cell, policy, { more = [], visits = true, ...options } = {}, opened = () => undefined) {
  const dashboard = { server: new Server(cell, policy, more), chromium: new Browser(), page: null, url: null };
  before(async () => {
    dashboard.url = await dashboard.server.start();
    dashboard.page = await dashboard.chromium.open({ colorScheme: 'dark', ...options });
    if (visits) await dashboard.chromium.visit(dashboard.url);
    await opened(dashboard);
  }, { timeout: 300_000 });
  afterEach(async ({ name, passed }) => {
    const picture = path_for(`failed-${name.replaceAll(/[^a-z0-9]+/gi, '-')}`);
    if (passed === false && picture.path) await dashboard.page?.screenshot(picture).catch(() => undefined);  // the page may be closed
  }, { timeout: 120_000 });
  after(async () => {
    await dashboard.chromium.close();
    await dashboard.server.end();
  }, { timeout: 120_000 });
  return dashboard;
}

/**
 * Retries until `claim` throws no assertion error, and returns the result of `claim`. Retries are
 * needed because on a busy machine the page follows the server seconds later. Other errors are
 * thrown at once.
 */
export async function eventually(claim, patience_ms = kPatience_ms) {
  for (const until_ms = Date.now() + patience_ms; ;) {
    try {
      return await claim();
    } catch (error) {
      if (!(error instanceof assert.AssertionError) || Date.now() > until_ms) throw error;
    }
    await new Promise((done) => setTimeout(done, kAgain_ms));
  }
}

/** Waits until the visible text of the element matches. */
export function reads(locator, pattern) {
  return eventually(async () => assert.match(await locator.innerText(), pattern));
}

/**
 * Returns the label of an arm in the view. Looks for the exact name, because the words of a label
 * can contain another arm's name.
 */
export function label_of(page, arm) {
  return page.locator('.arm-label').filter({ has: page.locator('b').getByText(arm, { exact: true }) });
}

/** Waits until there are `count` such elements. */
export function counts(locator, count, words) {
  return eventually(async () => assert.equal(await locator.count(), count, words));
}

/**
 * Waits until the page's address matches, and returns the address. Asks the page, because
 * Playwright's own copy of the address is late.
 */
export function address_like(page, pattern) {
  return eventually(async () => {
    const address = await page.evaluate(() => location.href).catch(() => 'none: it is being left');
    assert.match(address, pattern);
    return address;
  });
}

/** Returns the view as a PNG in full quality after all changes are drawn. */
export async function view_picture(page) {
  for (let i = 0; i < 2; i++) await page.evaluate(() => window.armloom.drawn());
  return page.locator('.view canvas').screenshot();
}

/** Waits until the view differs from a picture by more than `least_px` pixels. */
export function looks_different(page, before, least_px, what = 'pixels changed') {
  return eventually(async () => {
    const { count } = await difference(page.context(), before, await view_picture(page));
    assert.ok(count > least_px, `${count} ${what}`);
  });
}

/** Changes the page's address without a reload, and waits until the page shows it. */
export function go_to(page, hash) {
  return page.evaluate((hash) => new Promise((done) => {
    const before = location.hash;
    window.addEventListener('hashchange', () => setTimeout(done), { once: true });
    location.hash = hash;
    if (location.hash === before) done();
  }), hash);
}

/** Waits until a job is among the finished jobs. */
export function finished(page, id) {
  return page.locator(`[data-test=list-finished] [data-test="job-${id}"]`).waitFor();
}

/** Returns Playwright's path option for a screenshot, or no option if screenshots are not kept. */
export function path_for(name) {
  if (!kPictures) return {};
  mkdirSync(kPictures, { recursive: true });
  return { path: join(kPictures, `${name}.png`) };
}

/** Sends a request from the page; returns its status and JSON. */
export function ask(page, method, path, body) {
  return page.evaluate(async ([method, path, body]) => {
    const init = { method, headers: { 'content-type': 'application/json' } };
    if (body !== undefined) init.body = JSON.stringify(body);
    const answer = await fetch(`/api/v1${path}`, init);
    const text = await answer.text();
    return { status: answer.status, value: text === '' ? null : JSON.parse(text) };
  }, [method, path, body]);
}

/**
 * Confirms the checklist and resumes all arms, as a user does. Then returns to the previous page.
 */
export async function resume(page, press = (locator) => locator.click()) {
  const hash = await page.evaluate(() => location.hash);
  await press(page.locator('[data-test=to-resume]'));
  await page.locator('[data-test=resume-checked]').waitFor();
  for (let i = 0; i < 4; i++) await press(page.locator(`[data-test=check-${i}]`));
  await press(page.locator('[data-test=resume-checked]'));
  await page.locator('[data-test=checks-left]', { hasText: 'No arm is stopped' }).waitFor();
  await go_to(page, hash);
}

/** Drops files on the center of an element. */
export async function drop_files(page, files, selector) {
  const { x, y, width, height } = await page.locator(selector).boundingBox();
  const session = await page.context().newCDPSession(page);
  const at = { x: x + width / 2, y: y + height / 2, data: { items: [], files, dragOperationsMask: 1 } };
  for (const type of ['dragEnter', 'dragOver', 'drop']) await session.send('Input.dispatchDragEvent', { type, ...at });
  await session.detach();
}

/** Returns what a button copies to the clipboard. */
export async function copied_by(page, button) {
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await button.click();
  await button.getByText(': copied').waitFor();
  return page.evaluate(() => navigator.clipboard.readText());
}

/** Runs a command with exactly this environment and returns its output. */
export async function run(program, words, env = {}) {
  const { stdout } = await promisify(execFile)(program, words, { env: { PATH: process.env.PATH, ...env } });
  return stdout;
}

/** Returns a job through these configurations, `seconds` apart. The arm is at rest at each. */
export function job_through(id, joint_names, configurations, seconds, over = {}) {
  const rest = joint_names.map(() => 0);
  const points = configurations.map((positions, i) => ({
    positions, velocities: rest, accelerations: rest, time_from_start: { sec: i * seconds, nanosec: 0 },
  }));
  return { id, trajectory: { joint_names, points }, ...over };
}

/**
 * Returns an arm's joint names and positions from the server, because the page's data may be older.
 */
export async function arm_now(page, arm) {
  const { status, value } = await ask(page, 'GET', `/arms/${arm}`);
  assert.equal(status, 200, JSON.stringify(value));
  return { names: value.joints, q: value.q };
}

/**
 * Sends a job from the arm's position through the joint configurations `way`. Null in `way` means
 * the start position.
 */
export async function send_through(page, arm, id, way, seconds, over = {}) {
  const { names, q } = await arm_now(page, arm);
  const { status, value } = await ask(page, 'POST', '/jobs', job_through(id, names, [q, ...way.map((to) => to ?? q)], seconds, over));
  assert.equal(status, 202, JSON.stringify(value));
}
