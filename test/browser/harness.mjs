// The dashboard in a real browser beside a real server, for the tests here.
//
//   ARMLOOM_BINARY          the server's binary, default build/armloom
//   ARMLOOM_WEB             the dashboard's files, default: the server's own choice, web/dist
//   ARMLOOM_CHROMIUM        the browser, default /usr/bin/chromium
//   ARMLOOM_SCREENSHOT_DIR  where pictures of the page go; none are kept without it

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
// As Chromium draws by itself on a machine without a graphics card: software for WebGL, and the page put
// together without it. (`--use-angle=swiftshader` takes the page through it, too: 15 ms for each change.)
const kFlags = [
  '--use-angle=swiftshader-webgl', '--enable-unsafe-swiftshader', '--no-sandbox', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync',
];
// A busy machine may take ten times as long as an idle one; who fails waits for it in vain, nobody else.
export const kPatience_ms = 60_000;
const kAgain_ms = 50;

/** A server of one cell; it can be ended, and begun anew at the same address. */
export class Server {
  constructor(cell, policy, more = []) {
    this.arguments_ = ['serve', '--cell', cell, '--policy', policy, ...more];
    if (process.env.ARMLOOM_WEB) this.arguments_.push('--web', resolve(process.env.ARMLOOM_WEB));
    this.listen_ = '127.0.0.1:0';
  }

  /** Answers its address, as it says it itself. */
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

  /** It keeps its connections and says nothing, as one that hangs; until it is thawed. */
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

/** A browser with a profile of its own; `errors` gets what its console calls one. */
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

  /** The dashboard, connected and drawn. */
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
 * A server and a browser that looks at it, from before a suite's tests until after them; `page` and `url` are there
 * by then, and given to `opened`. `more`: what the server is told; `visits`: no, where the page cannot be had yet;
 * the rest is the browser's.
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
    if (passed === false && picture.path) await dashboard.page?.screenshot(picture).catch(() => undefined);  // it may be closed
  }, { timeout: 120_000 });
  after(async () => {
    await dashboard.chromium.close();
    await dashboard.server.end();
  }, { timeout: 120_000 });
  return dashboard;
}

/**
 * Asks again and again until nothing is to be said against it, and answers what that answers: what the page shows
 * follows what it was told, on a busy machine seconds later. Only what `assert` throws is put up with meanwhile.
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

/** Kept once what is to be read of it is like this. */
export function reads(locator, pattern) {
  return eventually(async () => assert.match(await locator.innerText(), pattern));
}

/** The label of an arm in the view. (Its words can hold the name of another arm.) */
export function label_of(page, arm) {
  return page.locator('.arm-label').filter({ has: page.locator('b').getByText(arm, { exact: true }) });
}

/** Kept once there are so many. */
export function counts(locator, count, words) {
  return eventually(async () => assert.equal(await locator.count(), count, words));
}

/** Answers the page's address once it is like this. (What playwright takes for it comes later.) */
export function address_like(page, pattern) {
  return eventually(async () => {
    const address = await page.evaluate(() => location.href).catch(() => 'none: it is being left');
    assert.match(address, pattern);
    return address;
  });
}

/** The cell as a PNG, with nothing left out, once all that changed has been drawn. */
export async function view_picture(page) {
  for (let i = 0; i < 2; i++) await page.evaluate(() => window.armloom.drawn());
  return page.locator('.view canvas').screenshot();
}

/** Kept once the cell looks clearly different from a picture of it, by more than so many pixels. */
export function looks_different(page, before, least_px, what = 'pixels changed') {
  return eventually(async () => {
    const { count } = await difference(page.context(), before, await view_picture(page));
    assert.ok(count > least_px, `${count} ${what}`);
  });
}

/** The page's address, without a reload; kept once the page has heard of it, and shows that place. */
export function go_to(page, hash) {
  return page.evaluate((hash) => new Promise((done) => {
    const before = location.hash;
    window.addEventListener('hashchange', () => setTimeout(done), { once: true });
    location.hash = hash;
    if (location.hash === before) done();
  }), hash);
}

/** Kept once a job stands among those that have ended. */
export function finished(page, id) {
  return page.locator(`[data-test=list-finished] [data-test="job-${id}"]`).waitFor();
}

/** Where a picture of this name goes, as playwright wants it. */
export function path_for(name) {
  if (!kPictures) return {};
  mkdirSync(kPictures, { recursive: true });
  return { path: join(kPictures, `${name}.png`) };
}

/** Sends a request from the page; answers its status and JSON. */
export function ask(page, method, path, body) {
  return page.evaluate(async ([method, path, body]) => {
    const init = { method, headers: { 'content-type': 'application/json' } };
    if (body !== undefined) init.body = JSON.stringify(body);
    const answer = await fetch(`/api/v1${path}`, init);
    const text = await answer.text();
    return { status: answer.status, value: text === '' ? null : JSON.parse(text) };
  }, [method, path, body]);
}

/** Lets all arms go on, as a person does: what is to be looked at is ticked first. Leads back to where the page was. */
export async function resume(page, press = (locator) => locator.click()) {
  const hash = await page.evaluate(() => location.hash);
  await press(page.locator('[data-test=to-resume]'));
  await page.locator('[data-test=resume-checked]').waitFor();
  for (let i = 0; i < 4; i++) await press(page.locator(`[data-test=check-${i}]`));
  await press(page.locator('[data-test=resume-checked]'));
  await page.locator('[data-test=checks-left]', { hasText: 'No arm is stopped' }).waitFor();
  await go_to(page, hash);
}

/** Files from a desktop, dropped on the middle of what a selector names. */
export async function drop_files(page, files, selector) {
  const { x, y, width, height } = await page.locator(selector).boundingBox();
  const session = await page.context().newCDPSession(page);
  const at = { x: x + width / 2, y: y + height / 2, data: { items: [], files, dragOperationsMask: 1 } };
  for (const type of ['dragEnter', 'dragOver', 'drop']) await session.send('Input.dispatchDragEvent', { type, ...at });
  await session.detach();
}

/** What a button puts on the clipboard. */
export async function copied_by(page, button) {
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await button.click();
  await button.getByText(': copied').waitFor();
  return page.evaluate(() => navigator.clipboard.readText());
}

/** What a command answers, in this environment and no other one. */
export async function run(program, words, env = {}) {
  const { stdout } = await promisify(execFile)(program, words, { env: { PATH: process.env.PATH, ...env } });
  return stdout;
}

/** A job through these configurations, `seconds` from each to the next, at rest at each. */
export function job_through(id, joint_names, configurations, seconds, over = {}) {
  const rest = joint_names.map(() => 0);
  const points = configurations.map((positions, i) => ({
    positions, velocities: rest, accelerations: rest, time_from_start: { sec: i * seconds, nanosec: 0 },
  }));
  return { id, trajectory: { joint_names, points }, ...over };
}

/** An arm's joints and where they are, as the server has it: what the page has may be older. */
export async function arm_now(page, arm) {
  const { status, value } = await ask(page, 'GET', `/arms/${arm}`);
  assert.equal(status, 200, JSON.stringify(value));
  return { names: value.joints, q: value.q };
}

/** Sends a job of an arm from where it is, through places of its joints; null: where it is. */
export async function send_through(page, arm, id, way, seconds, over = {}) {
  const { names, q } = await arm_now(page, arm);
  const { status, value } = await ask(page, 'POST', '/jobs', job_through(id, names, [q, ...way.map((to) => to ?? q)], seconds, over));
  assert.equal(status, 202, JSON.stringify(value));
}
