// Finds the job for one side of a diagram. The side names a job or an arm. If it names an arm, the
// arm's current job is used, else its next, else its last job. Pure.

import type { Job } from '../server/messages';
import type { JobList } from '../state/job_book';
import { kText } from '../strings';

interface Known { job(id: string): Job | null; jobs(list: JobList): readonly Job[]; arms: ReadonlyMap<string, unknown> }

const kInTurn: readonly JobList[] = ['running', 'scheduled', 'backlog', 'queued', 'finished'];

/**
 * Returns the job of a side. Returns null if the page does not know the job; the server may still
 * know it.
 */
export function job_of_side(name: string, store: Known): Job | null {
  return store.job(name) ?? (is_arm(name, store) ? job_of_arm(name, store) : null);
}

/** Returns true if the name is an arm and not also a job's id. */
export function is_arm(name: string, store: Known): boolean {
  return store.job(name) === null && store.arms.has(name);
}

/**
 * Returns the current, next or last job of an arm. Relies on the order of the lists: the server's
 * order, and ended jobs newest first.
 */
function job_of_arm(arm: string, store: Known): Job | null {
  for (const list of kInTurn) {
    const job = store.jobs(list).find(({ arms }) => arms.includes(arm));
    if (job) return job;
  }
  return null;
}

/** Returns why two sides have no diagram, or null if they have one. */
export function why_no_pair(a: string, b: string, store: Known): string | null {
  const [job_a, job_b] = [job_of_side(a, store), job_of_side(b, store)];
  const idle = [[a, job_a], [b, job_b]].find(([name, job]) => job === null && is_arm(name as string, store));
  if (idle) return kText.diagram.no_path_yet(String(idle[0]));
  if (!job_a || !job_b) return null;
  if (job_a.id === job_b.id) return a === b ? kText.diagram.same_side : kText.diagram.one_job;
  const arms = new Set([...job_a.arms, ...job_b.arms]);
  return arms.size === 1 ? kText.diagram.same_arm : null;
}
