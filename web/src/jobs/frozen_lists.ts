// The lists of jobs while one of their rows is pointed at: it, and all above it, keep their places, so that a click
// meets the job that was looked at. Pure.

import type { Job } from '../server/messages';
import type { JobList } from '../state/job_book';

export type Lists = ReadonlyMap<JobList, readonly Job[]>;

/** `order`: the lists from top to bottom; what has come above the row since is shown when it is left. */
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
