// Describes since when a job is in its state, and when it is predicted to start and end, and when
// it expires. Pure. Times are cell time.

import type { Forecast, ForecastStep, Job } from '../server/messages';
import { is_terminal } from '../state/job_book';
import type { Store } from '../state/store';
import { kText } from '../strings';
import { seconds, until_in_words, waited_for } from '../wording';

const kWords = kText.figure;

/**
 * Returns the step of the predicted timeline that belongs to a job. Null if it has none, or has ended
 * since the prediction, or has begun and has steps: the prediction has only its first motion.
 */
export function step_of({ id, state, steps, started_s }: Pick<Job, 'id' | 'state' | 'steps' | 'started_s'>, forecast: Forecast | null): ForecastStep | null {
  if (is_terminal({ state }) || (steps !== undefined && started_s !== null)) return null;
  return forecast?.arms.flatMap((lane) => lane.steps).find((known) => known.id === id) ?? null;
}

/**
 * Returns the predicted end of a job. Null if it is unknown, because something that no running job
 * ends is in the way, or because the job expires before.
 */
export function known_end_of(job: Job, step: ForecastStep | null): number | null {
  const ends_s = step?.ends_s ?? null;
  const is_known = ends_s !== null && until_in_words(job) === '' && (job.expires_s === undefined || job.expires_s > ends_s);
  return is_known ? ends_s : null;
}

/**
 * Returns which job goes before a job that waits its turn, and how many jobs that are, and how long
 * the arm has been at rest if this is its next job: "behind arm3-16 (12 jobs), at rest 28 s".
 */
export function turn_in_words(job: Job, store: Pick<Store, 't_s' | 'rests_since' | 'jobs_ahead' | 'arms' | 'arm_state' | 'waiting_of'>): { behind: string; more: string } {
  const words = kText.wait;
  const ahead = store.jobs_ahead(job);
  const rests = job.arms.some((name) => {
    const arm = store.arms.get(name);
    return arm && store.arm_state(arm) === 'waiting' && store.waiting_of(name)?.id === job.id;
  });
  const more = ahead === null ? '' : ` (${words.jobs_ahead(ahead)})`;
  const rest = rests ? `, ${words.at_rest(whole_seconds(store.t_s - store.rests_since(job)))}` : '';
  return { behind: waited_for(job), more: more + rest };
}

function whole_seconds(s: number): string {
  return s < 60 ? `${Math.max(0, Math.floor(s))} s` : seconds(s);
}

export function when_in_words(job: Job, store: Pick<Store, 't_s' | 'book' | 'forecast'>): string {
  const now_s = store.t_s;
  const step = step_of(job, store.forecast);
  const parts: string[] = [];
  const since_s = store.book.since(job.id);
  const until = until_in_words(job);
  if (job.state === 'backlogged') parts.push(kWords.blocked_for(seconds(Math.max(0, now_s - (job.backlogged_s ?? since_s ?? now_s)))));
  if (job.state === 'paused' && since_s !== null) parts.push(kWords.paused_for(seconds(Math.max(0, now_s - since_s))));
  if (until !== '' && parts.length > 0) parts[0] = `${parts[0]}, ${until}`;
  const starts_s = step ? step.starts_s : job.scheduled_s;
  if (until === '' && job.started_s === null && starts_s !== null) {
    parts.push(starts_s > now_s + 0.05 ? kWords.starts_in(seconds(starts_s - now_s)) : kWords.about_to_start);
  }
  if (until === '' && step && step.starts_s === null) parts.push(kWords.not_scheduled);
  if (until === '' && step && job.state === 'paused') {
    const ends_s = known_end_of(job, step);
    parts.push(ends_s === null ? kWords.end_unknown : kWords.ends_in(seconds(Math.max(0, ends_s - now_s))));
  }
  if (job.expires_s !== undefined) parts.push(kWords.expires_in(seconds(Math.max(0, job.expires_s - now_s))));
  return parts.join(' · ');
}
