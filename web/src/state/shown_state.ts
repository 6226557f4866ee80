// Distinguishes stopped from paused. Pure. The server reports `paused` for both; a stopped job
// additionally waits for resume.

import type { ArmState, Job, JobState } from '../server/messages';

/** `not known`: no data for the shown time. `waiting`: idle, and its next job waits. */
export type ShownState = ArmState | 'waiting' | 'not known';

/** Returns true if a job waits for the resume of an arm: `arm`, or any if null. */
export function is_stopped(job: Pick<Job, 'waits_on'> | null, arm: string | null = null): boolean {
  return job?.waits_on.some((wait) => wait.kind === 'stop' && (arm === null || wait.arm === null || wait.arm === arm)) ?? false;
}

/** Returns the state as shown to people. */
export function shown_state(job: Pick<Job, 'state' | 'waits_on'>): JobState | 'stopped' {
  return job.state === 'paused' && is_stopped(job) ? 'stopped' : job.state;
}
