// The measured progress of jobs over time, from which diagrams draw the measured path. Ten points
// per second are kept for each of the last jobs, up to a limit per job.

import type { ArmAuthority } from '../server/messages';

const kStep_s = 0.1;
const kMostJobs = 200;
const kMostPoints = 1200;
// If the first recorded progress is at most this, the job counts as recorded from its beginning.
const kBeginning_s = 0.3;

/**
 * The progress of one job: trajectory time `progress_s` at each cell time `t_s`. Both only grow.
 */
export interface Course { t_s: number[]; progress_s: number[] }

export class ProgressBook {
  private readonly courses_ = new Map<string, Course>();

  /**
   * Adds the progress of each job. A job of several arms is listed several times; its first entry
   * is used.
   */
  take(t_s: number, motions: readonly Pick<ArmAuthority, 'job' | 'progress_s'>[]): void {
    const seen = new Set<string>();
    for (const { job, progress_s } of motions) {
      if (seen.has(job)) continue;
      seen.add(job);
      push(this.course(job), t_s, progress_s);
    }
  }

  of(job: string): Course | null {
    return this.courses_.get(job) ?? null;
  }

  clear(): void {
    this.courses_.clear();
  }

  private course(job: string): Course {
    const known = this.courses_.get(job);
    if (known) return known;
    const course = { t_s: [], progress_s: [] };
    this.courses_.set(job, course);
    for (const oldest of this.courses_.keys()) {
      if (this.courses_.size <= kMostJobs) break;
      this.courses_.delete(oldest);
    }
    return course;
  }
}

/** Adds a point. While the job rests, only the first and the last point of the rest are kept. */
function push({ t_s, progress_s }: Course, at_s: number, progress: number): void {
  const n = t_s.length;
  const [last, before] = [progress_s[n - 1], progress_s[n - 2]];
  const stands_on = n > 1 && progress === last && progress === before;
  const moves_on = n > 1 && progress !== last && last !== before && at_s - (t_s[n - 2] ?? 0) < kStep_s;
  if (stands_on || moves_on) {
    t_s[n - 1] = at_s;
    progress_s[n - 1] = progress;
    return;
  }
  t_s.push(at_s);
  progress_s.push(progress);
  if (t_s.length <= kMostPoints) return;
  for (const list of [t_s, progress_s]) list.splice(0, list.length, ...list.filter((_, i) => i % 2 === 0 || i === list.length - 1));
}

/**
 * Returns the progress at a time. Before the first point it is null, or 0 if the job was recorded
 * from its beginning.
 */
export function progress_at({ t_s, progress_s }: Course, at_s: number): number | null {
  let [low, high] = [0, t_s.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((t_s[middle] ?? Infinity) <= at_s) low = middle + 1;
    else high = middle;
  }
  const [from, to] = [progress_s[low - 1], progress_s[low]];
  if (from === undefined) return to === undefined || to > kBeginning_s ? null : 0;
  if (to === undefined) return from;
  const [from_s = 0, to_s = 0] = [t_s[low - 1], t_s[low]];
  return from + ((to - from) * (at_s - from_s)) / (to_s - from_s);
}
