// The filter of the job lists. Pure.

import type { Job } from '../server/messages';

const kFailed: ReadonlySet<Job['state']> = new Set(['failed', 'expired', 'interrupted', 'canceled'] as const);

/**
 * Returns true if each of the words occurs in the job's id, name, arms, state, result reason or
 * waits.
 */
export function matches(job: Job, words: string, only_failed: boolean): boolean {
  if (only_failed && !kFailed.has(job.state)) return false;
  const wanted = words.toLowerCase().split(/\s+/).filter((word) => word !== '');
  if (wanted.length === 0) return true;
  const waits = job.waits_on.flatMap((wait) => [wait.kind, wait.id ?? '', wait.arm ?? '', ...wait.links]);
  const text = [job.id, job.name, ...job.arms, job.state, job.result?.reason ?? '', ...waits].join(' ').toLowerCase();
  return wanted.every((word) => text.includes(word));
}
