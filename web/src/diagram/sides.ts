// What an address names on one side of a diagram: a job, or an arm, which stands for the job that it
// executes, else for the one that it does next, else for the one that it did last. Pure.

import type { Job } from '../server/messages';
import type { JobList } from '../state/job_book';
import { kText } from '../strings';

interface Known { job(id: string): Job | null; jobs(list: JobList): readonly Job[]; arms: ReadonlyMap<string, unknown> }

const kInTurn: readonly JobList[] = ['running', 'scheduled', 'backlog', 'queued', 'finished'];

/** null: the page knows no job of it; the server may. */
export function job_of_side(name: string, store: Known): Job | null {
  return store.job(name) ?? (is_arm(name, store) ? job_of_arm(name, store) : null);
}

/** A job that is called as an arm is goes before it. */
export function is_arm(name: string, store: Known): boolean {
  return store.job(name) === null && store.arms.has(name);
}

/** Lists stand in the server's order, those that have ended newest first. */
function job_of_arm(arm: string, store: Known): Job | null {
  for (const list of kInTurn) {
    const job = store.jobs(list).find(({ arms }) => arms.includes(arm));
    if (job) return job;
  }
  return null;
}

/** Why two sides make no diagram; null: they may. */
export function why_no_pair(a: string, b: string, store: Known): string | null {
  const [job_a, job_b] = [job_of_side(a, store), job_of_side(b, store)];
  const idle = [[a, job_a], [b, job_b]].find(([name, job]) => job === null && is_arm(name as string, store));
  if (idle) return kText.diagram.no_path_yet(String(idle[0]));
  if (!job_a || !job_b) return null;
  if (job_a.id === job_b.id) return a === b ? kText.diagram.same_side : kText.diagram.one_job;
  const arms = new Set([...job_a.arms, ...job_b.arms]);
  return arms.size === 1 ? kText.diagram.same_arm : null;
}
