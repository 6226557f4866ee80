// The states of arms and jobs as the page shows them. Pure. The server reports `paused` for paused
// and for stopped jobs. A stopped job also waits for its arm to be resumed.

import type { Arm, ArmState, Job, JobState } from '../server/messages';

/**
 * The state of an arm as the page shows it. `not known` means no data for the shown time. `waiting`
 * means idle while the arm's next job waits. `link lost` and `connecting` replace the server's
 * state, which is as old as the last report of the arm's controller.
 */
export type ShownState = ArmState | 'waiting' | 'link lost' | 'connecting' | 'not known';

/** Returns the state that follows from the arm's link alone, or null if the link works. */
export function state_by_link({ link }: Pick<Arm, 'link'>): ShownState | null {
  switch (link) {
    case 'lost': return 'link lost';
    case 'connecting': return 'connecting';
    case 'up': case 'stale': return null;
  }
}

/**
 * Returns true if the arm must be resumed before it moves again. An arm whose controller has never
 * connected is resumed by its first connection.
 */
export function is_halted({ state, link }: Pick<Arm, 'state' | 'link'>): boolean {
  return link === 'lost' || (link !== 'connecting' && (state === 'stopped' || state === 'fault'));
}

export function is_alarming(state: ShownState): boolean {
  return state === 'stopped' || state === 'fault' || state === 'link lost';
}

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
