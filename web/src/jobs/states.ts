// The states of a job with their times. They are taken from events, else from the job itself. Pure.

import type { Job } from '../server/messages';
import { is_terminal, type Change, type Pause } from '../state/job_book';
import { kText } from '../strings';
import { seconds, wait_in_words } from '../wording';

// A state that lasted less than this is left out, because it was only a transition.
const kLeast_s = 0.005;

/**
 * A state and the cell time at which it began. The time is null if the state is not reached yet.
 */
export type StateAt = readonly [name: string, t_s: number | null];

export function states_of(job: Job, heard: readonly Change[]): StateAt[] {
  const end: StateAt = [is_terminal(job) ? job.state : kText.job.ended, job.ended_s];
  const lasting = heard.filter(({ t_s }, i) => (heard[i + 1]?.t_s ?? Infinity) - t_s > kLeast_s);
  // A job with steps pauses and runs at each step, which the list of its steps shows.
  const is_told = ({ state, t_s }: Change) => job.steps === undefined || job.started_s === null || state === 'stopped' || t_s < job.started_s;
  const on_the_way = lasting.filter((change) => (change.state === 'stopped' || !is_terminal({ state: change.state })) && is_told(change));
  const started = job.started_s === null || !on_the_way.some(({ state }) => state === 'running');
  const steps: StateAt[] = on_the_way.map(({ state, t_s }) => [state, t_s]);
  if (started) steps.push([kText.job.started, job.started_s]);
  const by_time = steps.sort(([, a], [, b]) => (a ?? Infinity) - (b ?? Infinity));
  return [[kText.job.submitted, job.submitted_s], ...by_time, end];
}

/** Returns why and for how long a job was paused; empty if unknown or still paused. */
export function pause_in_words({ from_s, to_s, why }: Pause): string {
  return why === null || to_s === null ? '' : kText.wait.past(wait_in_words(why).replace(/^waits/, kText.wait.was_waiting), seconds(to_s - from_s));
}
