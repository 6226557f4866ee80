// Keeps job rows in place while the pointer is on a row, so that a click hits the intended job.
// Pure.

import type { Job } from '../server/messages';
import type { JobList } from '../state/job_book';

export type Lists = ReadonlyMap<JobList, readonly Job[]>;

/**
 * Keeps the row under the pointer and all rows above it in place. `order` names the lists from top
 * to bottom. Rows are added, moved or removed there only after the pointer has left.
 */
export function frozen_lists(order: readonly JobList[], now: Lists, before: Lists, pointed_at: string | null): Lists {
  const at = order.findIndex((list) => before.get(list)?.some(({ id }) => id === pointed_at));
  if (pointed_at === null || at < 0) return now;
  const latest = new Map([...now.values()].flat().map((job) => [job.id, job]));
  const kept = new Map<JobList, Job[]>();
  const placed = new Set<string>();
  order.slice(0, at + 1).forEach((list, i) => {
    const jobs = before.get(list) ?? [];
    const until = i < at ? jobs.length : jobs.findIndex(({ id }) => id === pointed_at) + 1;
    kept.set(list, jobs.slice(0, until).map((job) => latest.get(job.id) ?? job));
    for (const { id } of jobs.slice(0, until)) placed.add(id);
  });
  return new Map(order.map((list, i) => [list, [...kept.get(list) ?? [], ...(i < at ? [] : (now.get(list) ?? []).filter(({ id }) => !placed.has(id)))]]));
}
