// Describes since when a job is in its state, and when it is predicted to start and end, and when
// it expires. Pure. Times are cell time.

import type { Forecast, ForecastStep, Job } from '../server/messages';
import { is_stopped } from '../state/shown_state';
import type { Store } from '../state/store';
import { kText } from '../strings';
import { seconds } from '../wording';

const kWords = kText.figure;

/** Returns the step of the predicted timeline that belongs to a job, or null if it has none. */
export function step_of({ id }: Pick<Job, 'id'>, forecast: Forecast | null): ForecastStep | null {
  return forecast?.arms.flatMap((lane) => lane.steps).find((known) => known.id === id) ?? null;
}

export function when_in_words(job: Job, store: Pick<Store, 't_s' | 'book' | 'forecast'>): string {
  const now_s = store.t_s;
  const step = step_of(job, store.forecast);
  const parts: string[] = [];
  const since_s = store.book.since(job.id);
  if (job.state === 'backlogged') parts.push(kWords.blocked_for(seconds(Math.max(0, now_s - (job.backlogged_s ?? since_s ?? now_s)))));
  if (job.state === 'paused' && since_s !== null) parts.push(kWords.paused_for(seconds(Math.max(0, now_s - since_s))));
  const starts_s = step ? step.starts_s : job.scheduled_s;
  const stopped = is_stopped(job);  // the reason for the wait says this already
  if (!stopped && job.started_s === null && starts_s !== null) {
    parts.push(starts_s > now_s + 0.05 ? kWords.starts_in(seconds(starts_s - now_s)) : kWords.about_to_start);
  }
  if (!stopped && step && step.starts_s === null) parts.push(kWords.not_scheduled);
  if (!stopped && step && job.state === 'paused') parts.push(step.ends_s === null ? kWords.end_unknown : kWords.ends_in(seconds(Math.max(0, step.ends_s - now_s))));
  if (job.expires_s !== undefined) parts.push(kWords.expires_in(seconds(Math.max(0, job.expires_s - now_s))));
  return parts.join(' · ');
}
