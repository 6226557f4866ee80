import { describe, expect, it } from 'vitest';
import { frozen_lists, type Lists } from '../src/jobs/frozen_lists';
import type { Job } from '../src/server/messages';
import type { JobList } from '../src/state/job_book';
import { job_json } from './samples';

const kOrder: readonly JobList[] = ['running', 'backlog', 'queued', 'finished'];
const job = (id: string, over: object = {}) => job_json(id, over) as unknown as Job;
const lists = (ids: Partial<Record<JobList, Job[]>>): Lists => new Map(kOrder.map((list) => [list, ids[list] ?? []]));
const told = (lists: Lists) => kOrder.map((list) => (lists.get(list) ?? []).map(({ id }) => id).join(' '));

describe('the lists of jobs while a row is pointed at', () => {
  const before = lists({ running: [job('a')], backlog: [job('b'), job('c'), job('d')], queued: [job('e')] });
  const now = lists({ running: [job('d', { state: 'running' }), job('x')], backlog: [job('c')], queued: [job('y'), job('e')], finished: [job('a', { state: 'succeeded' }), job('b')] });

  it('keep it and all above it where they were, and each job once', () => {
    expect(told(frozen_lists(kOrder, now, before, 'c'))).toEqual(['a', 'b c', 'y e', '']);
    expect(told(frozen_lists(kOrder, now, before, 'b'))).toEqual(['a', 'b c', 'y e', '']);
    expect(told(frozen_lists(kOrder, now, before, 'd'))).toEqual(['a', 'b c d', 'y e', '']);
  });
  it('tell of each job as it is now', () => {
    expect(frozen_lists(kOrder, now, before, 'c').get('running')?.[0]?.state).toBe('succeeded');
  });
  it('are as they are once it is left, or is in none', () => {
    expect(frozen_lists(kOrder, now, before, null)).toBe(now);
    expect(frozen_lists(kOrder, now, before, 'gone')).toBe(now);
  });
});
