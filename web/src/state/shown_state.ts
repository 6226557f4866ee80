// Distinguishes stopped jobs from paused jobs. Pure. The server reports `paused` for both. A
// stopped job also waits for its arm to be resumed.

import type { ArmState, Job, JobState } from '../server/messages';

/**
 * The state of an arm as the page shows it. `not known` means no data for the shown time. `waiting`
 * means idle while the arm's next job waits.
 */
export type ShownState = ArmState | 'waiting' | 'not known';

/**
 * Returns true if a job waits for an arm to be resumed. This is `arm`, or any arm if `arm` is null.
 */
export function is_stopped(job: Pick<Job, 'waits_on'> | null, arm: string | null = null): boolean {
  return job?.waits_on.some((wait) => wait.kind === 'stop' && (arm === null || wait.arm === null || wait.arm === arm)) ?? false;
}

/** Returns the state of a job as the page shows it. */
export function shown_state(job: Pick<Job, 'state' | 'waits_on'>): JobState | 'stopped' {
  return job.state === 'paused' && is_stopped(job) ? 'stopped' : job.state;
}
