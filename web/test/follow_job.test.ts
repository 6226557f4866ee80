import { beforeEach, describe, expect, it } from 'vitest';
import type { Answer } from '../src/server/api';
import { follow_job } from '../src/server/follow_job';
import { parse_job, parse_message, type Job } from '../src/server/messages';
import { Store } from '../src/state/store';
import { envelope, job_json, snapshot } from './samples';

let store: Store;
let asked: string[];
let pending: (() => void)[];
let answer: Answer<Job>;

const api = {
  job: (id: string) => {
    asked.push(id);
    return Promise.resolve(answer);
  },
};
const timers = {
  set: (callback: () => void, delay_ms: number) => {
    expect(delay_ms).toBe(1000);
    return pending.push(callback);
  },
  clear: () => { pending = []; },
};
const settled = () => new Promise((done) => setTimeout(done, 0));

function take(text: string): void {
  const parsed = parse_message(text);
  if (parsed.kind !== 'message') throw new Error(JSON.stringify(parsed));
  store.take(parsed.message);
}

function answers(over: object): void {
  const job = parse_job(job_json('a', { state: 'running', ...over }));
  if (!job.ok) throw new Error(job.fault);
  answer = { ok: true, value: job.value };
}

async function a_second_passes(): Promise<void> {
  for (const callback of pending.splice(0)) callback();
  await settled();
}

beforeEach(() => {
  store = new Store();
  asked = [];
  pending = [];
  answers({ progress: 0.2 });
  store.set_link({ status: 'open' });
  take(snapshot(1, { jobs: [job_json('a', { state: 'running' })] }));
});

describe('follow_job', () => {
  it('polls at once and every second', async () => {
    follow_job('a', api, store, timers);
    await settled();
    expect(store.job('a')?.progress).toBe(0.2);
    answers({ progress: 0.5 });
    await a_second_passes();
    expect(asked).toEqual(['a', 'a']);
    expect(store.job('a')).toMatchObject({ progress: 0.5 });
  });

  it('ends with the job', async () => {
    follow_job('a', api, store, timers);
    await settled();
    take(envelope('job', 2, job_json('a', { state: 'succeeded', progress: 1 })));
    await a_second_passes();
    expect(asked).toHaveLength(1);
    expect(pending).toHaveLength(0);
    expect(store.job('a')?.progress).toBe(1);
  });

  it('ends on request and drops a late answer', async () => {
    const close = follow_job('a', api, store, timers);
    close();
    await settled();
    expect(store.job('a')?.progress).toBe(0);
    expect(pending).toHaveLength(0);
  });

  it('waits while the connection is lost, and continues after a refusal', async () => {
    store.set_link({ status: 'lost', attempt: 1, retry_in_ms: 250 });
    follow_job('a', api, store, timers);
    await settled();
    expect(asked).toEqual([]);
    store.set_link({ status: 'open' });
    answer = { ok: false, problem: { type: 'urn:x', title: 'x', status: 503, detail: '' } };
    await a_second_passes();
    answers({ progress: 0.7 });
    await a_second_passes();
    expect(asked).toHaveLength(2);
    expect(store.job('a')?.progress).toBe(0.7);
  });
});
