// The page of what blocks a job. Pure.

import type { Place } from '../route/address';
import type { Job } from '../server/messages';
import { object_of } from '../wording';

/**
 * Returns the page of the job, object or arm that the job waits for first. Null if there is none, for
 * example while its path is planned.
 */
export function blocker_of(job: Pick<Job, 'waits_on'>): Place | null {
  const [first] = job.waits_on;
  if (!first) return null;
  const object = object_of(job);
  if (object !== null) return { page: 'scene', name: object };
  if (first.kind === 'stop') return { page: 'recovery' };
  if (first.kind === 'arm') return first.arm === null ? null : { page: 'arm', name: first.arm };
  return first.id === null ? null : { page: 'job', id: first.id };
}
