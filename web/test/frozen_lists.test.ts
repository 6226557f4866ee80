import { describe, expect, it } from 'vitest';
import { frozen_lists, type Lists } from '../src/jobs/frozen_lists';
import type { Job } from '../src/server/messages';
import type { JobList } from '../src/state/job_book';
import { job_json } from './samples';

const kOrder: readonly JobList[] = ['running', 'backlog', 'queued', 'finished'];
const job = (id: string, over: object = {}) => job_json(id, over) as unknown as Job;
const lists = (ids: Partial<Record<JobList, Job[]>>): Lists => new Map(kOrder.map((list) => [list, ids[list] ?? []]));
const told = (lists: Lists) => kOrder.map((list) => (lists.get(list) ?? []).map(({ id }) => id).join(' '));

describe('Frozen job lists', () => {
  const before = lists({ running: [job('a')], backlog: [job('b'), job('c'), job('d')], queued: [job('e')] });
  const now = lists({ running: [job('d', { state: 'running' }), job('x')], backlog: [job('c')], queued: [job('y'), job('e')], finished: [job('a', { state: 'succeeded' }), job('b')] });

  it('keep the pointed row and all rows above in place, each job once', () => {
    expect(told(frozen_lists(kOrder, now, before, 'c'))).toEqual(['a', 'b c', 'y e', '']);
    expect(told(frozen_lists(kOrder, now, before, 'b'))).toEqual(['a', 'b c', 'y e', '']);
    expect(told(frozen_lists(kOrder, now, before, 'd'))).toEqual(['a', 'b c d', 'y e', '']);
  });
  it('show the current state of each job', () => {
    expect(frozen_lists(kOrder, now, before, 'c').get('running')?.[0]?.state).toBe('succeeded');
  });
  it('are the current lists without a pointed row', () => {
    expect(frozen_lists(kOrder, now, before, null)).toBe(now);
    expect(frozen_lists(kOrder, now, before, 'gone')).toBe(now);
  });
});
