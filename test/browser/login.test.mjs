// A server that requires tokens: login, logout, and revoking a token while the page is open.
//
//   node --test test/browser/login.test.mjs      (after building the server and web/dist; see harness.mjs)

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { address_like, arm_now, copied_by, go_to, job_through, kBinary, path_for, run, with_dashboard } from './harness.mjs';

const folder = mkdtempSync(join(tmpdir(), 'armloom-login-'));
const tokens = join(folder, 'tokens');
const token_command = (...words) => execFileSync(kBinary, ['token', words[0], '--tokens', tokens, ...words.slice(1)], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }).trim();
const token = token_command('add', '--name', 'ada', '--role', 'operator');
const viewer = token_command('add', '--name', 'vic', '--role', 'viewer');

let url;
let page;
with_dashboard('config/two_pandas.json', 'coordinated', { more: ['--tokens', tokens], visits: false }, (opened) => { ({ page, url } = opened); });
after(() => rmSync(folder, { recursive: true }));

async function log_in(with_token) {
  await page.locator('#token').fill(with_token);
  await page.locator('button').click();
}
const connected = () => page.locator('[data-test=link]', { hasText: 'connected' }).waitFor();

test('Login page asks for a token and refuses a wrong one', { timeout: 300_000 }, async () => {
  await page.goto(url);
  await address_like(page, /\/login$/);
  await log_in('armloom_' + '0'.repeat(64));
  await page.locator('[role=alert]', { hasText: 'token is unknown or was revoked' }).waitFor();
  await log_in(token);
  await connected();
});

test('Acknowledgements have the name of the token', { timeout: 300_000 }, async () => {
  await page.locator('button', { hasText: 'Stop' }).first().click();
  await page.locator('[data-test=open-alerts]').click();
  await page.locator('[data-test=acknowledge-all]').click();
  await page.locator('[data-test=alerts]', { hasText: 'Acknowledged by ada' }).waitFor();
});

test('Copied snippets take the token from the environment', { timeout: 300_000 }, async () => {
  const { names, q } = await arm_now(page, 'left');
  await go_to(page, '#/new');
  await page.locator('[data-test=job-text]').fill(JSON.stringify(job_through('copied', names, [q, q], 1)));
  const curl = await copied_by(page, page.locator('.pane [data-test=copy-curl]'));
  assert.ok(!curl.includes(token));
  assert.match(await run('bash', ['-c', curl]), /"status": ?401/);
  assert.match(await run('bash', ['-c', curl], { ARMLOOM_TOKEN: token }), /"id": ?"copied"/);
  await go_to(page, '#/job/copied');
  const python = await copied_by(page, page.locator('.pane [data-test=copy-Python]'));
  assert.match(await run('python3', ['-c', python], { ARMLOOM_TOKEN: token }), /^(queued|backlogged|scheduled|running|succeeded) /);
});

test('Logging out returns to the login page', { timeout: 300_000 }, async () => {
  await page.locator('[data-test=more-pages]').click();
  await page.locator('[data-test=go-settings]').click();
  await page.locator('[data-test=session]', { hasText: 'ada, operator' }).waitFor();
  await page.screenshot(path_for('session-dark'));
  await page.locator('[data-test=log-out]').click();
  await page.waitForURL('**/login');
  await page.goto(`${url}#/arm/right`);
  await address_like(page, /\/login#\/arm\/right$/);
  await log_in(token);
  await connected();
  await address_like(page, /\/#\/arm\/right$/);  // the page requested before the login
});

test('Revoking a token sends its page to the login page', { timeout: 300_000 }, async () => {
  token_command('revoke', '--name', 'ada');
  await address_like(page, /\/login#\/arm\/right$/);
  await log_in(token);
  await page.locator('[role=alert]', { hasText: 'revoked' }).waitFor();
});

test('Commands are disabled for a viewer, with the reason', { timeout: 300_000 }, async () => {
  await log_in(viewer);
  await connected();
  await page.locator('[data-test=view-only]', { hasText: 'vic: view only' }).waitFor();
  await page.locator('[data-test=stop]', { hasText: 'your role does not allow this' }).waitFor();
  const off = async (name) => {
    const command = page.locator(`[data-test=${name}]`);
    await command.and(page.locator(':disabled')).waitFor();
    assert.match(await command.getAttribute('title'), /needs the operator role/, name);
  };
  await off('take-control');
  await go_to(page, '#/scene');
  await off('object-save');
  await go_to(page, '#/policies');
  await off('compare');
  await go_to(page, '#/new');
  await page.locator('[data-test=job-text]').fill('{"arm": "left", "move_to": {"named": "home"}}');
  await off('send');
  await page.locator('[data-test=check-job]').click();  // a check, because it changes nothing
  await page.locator('[data-test=check-results]').waitFor();
  await page.screenshot(path_for('viewer-dark'));
});
