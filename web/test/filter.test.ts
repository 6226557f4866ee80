import { describe, expect, it } from 'vitest';
import { matches } from '../src/jobs/filter';
import type { Job } from '../src/server/messages';
import { job_json, wait_json } from './samples';

const job = (over: object) => job_json('pick-7', { name: 'Pick the crate', arms: ['left', 'right'], ...over }) as unknown as Job;
const finds = (words: string, over: object = {}, only_failed = false) => matches(job(over), words, only_failed);

describe('Job filter', () => {
  it('accepts every job without words', () => {
    expect(finds('')).toBe(true);
    expect(finds('  \t ')).toBe(true);
  });

  it('finds words anywhere in a job, in any case', () => {
    for (const words of ['pick-7', 'CRATE', 'right', 'queued', 'crate left']) expect(finds(words), words).toBe(true);
    expect(finds('stopped', { result: { reason: 'operator_stopped' } })).toBe(true);
  });

  it('finds the blocking job, its arm and both links', () => {
    const over = { arms: ['left'], waits_on: [wait_json()] };
    for (const words of ['place-6', 'panda_link6', 'left_panda_hand', 'place-6 right']) expect(finds(words, over), words).toBe(true);
    expect(finds('place-6')).toBe(false);
  });

  it('requires all words', () => {
    expect(finds('crate running')).toBe(false);
  });

  it('accepts only jobs that did not succeed, on request', () => {
    const kept = ['queued', 'running', 'succeeded', 'failed', 'expired', 'interrupted', 'canceled'].filter((state) => finds('', { state }, true));
    expect(kept).toEqual(['failed', 'expired', 'interrupted', 'canceled']);
    expect(finds('nowhere', { state: 'failed' }, true)).toBe(false);
  });
});
