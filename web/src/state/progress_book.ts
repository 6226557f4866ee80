// How far jobs were on their ways, and when, as measured: what a diagram draws of two of them. Of each job
// one point a tenth of a second; of the last so many jobs, each no longer than so many points.

import type { ArmAuthority } from '../server/messages';

const kStep_s = 0.1;
const kMostJobs = 200;
const kMostPoints = 1200;
// It was heard from its beginning.
const kBeginning_s = 0.3;

/** Cell time, and trajectory time then: both only grow. */
export interface Course { t_s: number[]; progress_s: number[] }

export class ProgressBook {
  private readonly courses_ = new Map<string, Course>();

  /** A job of several arms is as far as the first of them that is told. */
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

/** One that stands has a point where it came to stand, and one where it was seen there last. */
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

/** How far it was at a time; null before its first point, unless that is its beginning. */
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
