import { describe, expect, it } from 'vitest';
import { partner_of } from '../src/diagram/partner';
import { kNothing, selection_of } from '../src/route/selection';
import type { Job } from '../src/server/messages';
import type { JobList } from '../src/state/job_book';
import type { Store } from '../src/state/store';
import { job_json, wait_json } from './samples';

const job = (id: string, arm: string, over: object = {}) => job_json(id, { arms: [arm], ...over }) as unknown as Job;

/** Returns a store with only the parts that these tests use. */
function store_of(lists: Partial<Record<JobList, Job[]>>, arms: string[] = ['left', 'right']): Store {
  const jobs = (list: JobList) => lists[list] ?? [];
  const all = Object.values(lists).flat();
  return { jobs, job: (id: string) => all.find((one) => one.id === id) ?? null, arms: new Map(arms.map((arm) => [arm, {}])) } as unknown as Store;
}

describe('Selection of an address', () => {
  const store = store_of({ running: [job('pick', 'left')], finished: [job('old', 'right')] });

  it('is a job and its arms', () => {
    expect(selection_of({ page: 'job', id: 'pick' }, store)).toEqual({ jobs: ['pick'], arms: ['left'], object: null });
  });
  it('is a job alone if the page does not know its arms', () => {
    expect(selection_of({ page: 'job', id: 'gone' }, store)).toEqual({ jobs: ['gone'], arms: [], object: null });
  });
  it('is the arms\' jobs if a pair names arms', () => {
    expect(selection_of({ page: 'pair', a: 'left', b: 'right' }, store)).toEqual({ jobs: ['pick', 'old'], arms: ['left', 'right'], object: null });
  });
  it('is an arm, an object or nothing', () => {
    expect(selection_of({ page: 'arm', name: 'left' }, store).arms).toEqual(['left']);
    expect(selection_of({ page: 'scene', name: 'table' }, store).object).toBe('table');
    expect(selection_of({ page: 'scene', name: null }, store)).toEqual(kNothing);
    expect(selection_of({ page: 'history' }, store)).toEqual(kNothing);
  });
});

describe('Diagram partner of a job', () => {
  it('is the job that it waits for', () => {
    const waits = job('pick', 'left', { waits_on: [wait_json({ kind: 'stop', id: null }), wait_json({ id: 'slow' })] });
    expect(partner_of(waits, store_of({ running: [waits, job('quick', 'right')], finished: [job('slow', 'right')] }))?.id).toBe('slow');
  });
  it('is the first job of another arm, running before waiting, if the blocker is unknown', () => {
    const waits = job('pick', 'left', { waits_on: [wait_json({ id: 'gone' })] });
    const lists = { queued: [job('later', 'right')], running: [waits, job('own', 'left'), job('moves', 'right')] };
    expect(partner_of(waits, store_of(lists))?.id).toBe('moves');
    expect(partner_of(waits, store_of({ ...lists, running: [waits] }))?.id).toBe('later');
  });
  it('is null if only its own arms have jobs', () => {
    const both = job('both', 'left', { arms: ['left', 'right'] });
    expect(partner_of(both, store_of({ running: [both], queued: [job('next', 'right')] }))).toBeNull();
  });
});
