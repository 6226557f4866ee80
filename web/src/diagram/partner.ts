// Chooses the other job for a job's diagram: the job that it waits for, else the first job of other
// arms. Unfinished jobs come before finished jobs.

import type { Job } from '../server/messages';
import type { Store } from '../state/store';
import { object_of } from '../wording';

export function partner_of(job: Job, store: Store): Job | null {
  const blocker = job.waits_on.find((wait) => wait.kind === 'job' && wait.id !== null);
  const known = blocker?.id ? store.job(blocker.id) : null;
  if (known) return known;
  if (!blocker && object_of(job) !== null) return null;  // the job waits for an object, which has no diagram
  const lists = ['running', 'scheduled', 'backlog', 'queued', 'finished'] as const;
  for (const list of lists) {
    const other = store.jobs(list).find((one) => one.id !== job.id && !one.arms.some((arm) => job.arms.includes(arm)));
    if (other) return other;
  }
  return null;
}
