// Why a job stands. Pure. The server says `paused` of every job that stands on its path; that its arm was
// stopped, and goes on only when somebody resumes it, is what the job waits for.

import type { ArmState, Job, JobState } from '../server/messages';

/** `not known`: of the time that is looked at nothing tells it. `waiting`: it is idle, and its next job waits. */
export type ShownState = ArmState | 'waiting' | 'not known';

/** Whether a job waits until an arm is resumed: this one, or any of its own. */
export function is_stopped(job: Pick<Job, 'waits_on'> | null, arm: string | null = null): boolean {
  return job?.waits_on.some((wait) => wait.kind === 'stop' && (arm === null || wait.arm === null || wait.arm === arm)) ?? false;
}

/** As people are told of it, everywhere. */
export function shown_state(job: Pick<Job, 'state' | 'waits_on'>): JobState | 'stopped' {
  return job.state === 'paused' && is_stopped(job) ? 'stopped' : job.state;
}
