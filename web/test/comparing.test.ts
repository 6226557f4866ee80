import { describe, expect, it } from 'vitest';
import { Comparing } from '../src/policies/comparing';
import { ends_in_words, share_in_words } from '../src/policies/run_words';
import type { Answer } from '../src/server/api';
import type { Comparison, PolicyRun } from '../src/server/messages';

const run = (over: Partial<PolicyRun> = {}): PolicyRun => ({
  policy: 'sequential', succeeded: 2, expired: 0, failed: 0, canceled: 0, refused: 0, unfinished: 0, backlogged: 1,
  makespan_s: 12, makespan_ratio: 1, wait_mean_s: 3, wait_max_s: 6, min_clearance_m: 0.04, monitor_stops: 0,
  evaluations: 100, given_up: false, ...over,
});
const comparison = (state: Comparison['state'], runs: PolicyRun[]): Comparison => ({
  state, jobs: 2, first_s: 1, last_s: 2, in_force: 'certified', policies: ['sequential', 'certified'], runs, detail: '',
});

describe('Policy comparison', () => {
  it('is polled while it runs, and not afterwards', async () => {
    const timers: (() => void)[] = [];
    const answers = [comparison('running', [run()]), comparison('done', [run(), run({ policy: 'certified' })])];
    const next = (): Promise<Answer<Comparison>> => Promise.resolve({ ok: true, value: answers.shift() ?? comparison('done', []) });
    const comparing = new Comparing({ compare: next, comparison: next, cancel_comparison: next }, { set: (callback) => timers.push(callback), clear: () => undefined });
    await comparing.start(null);
    expect(comparing.latest.value?.runs).toHaveLength(1);
    expect(timers).toHaveLength(1);
    timers.shift()?.();
    await new Promise((done) => setTimeout(done, 0));
    expect(comparing.latest.value?.state).toBe('done');
    expect(timers).toHaveLength(0);
  });

  it('says why it was refused', async () => {
    const no = (): Promise<Answer<Comparison>> => Promise.resolve({ ok: false, problem: { type: 'x', title: 'Conflict', status: 409, detail: 'no job was submitted' } });
    const comparing = new Comparing({ compare: no, comparison: no, cancel_comparison: no }, { set: () => 1, clear: () => undefined });
    await comparing.start(5);
    expect(comparing.refusal.value).toBe('no job was submitted');
  });

  it('describes jobs that did not succeed', () => {
    expect(ends_in_words(run())).toBe('');
    expect(ends_in_words(run({ expired: 1, unfinished: 2, given_up: true }))).toBe('1 expired, 2 unfinished, aborted: too many evaluations');
    expect([share_in_words(0.554), share_in_words(null)]).toEqual(['55 %', '–']);
  });
});
