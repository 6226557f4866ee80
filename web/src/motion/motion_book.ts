// Fetches the trajectory of a job when it is first needed. Caches the trajectories used last.
// Fetches it again after the job was replanned.

import { signal, untracked, type ReadonlySignal } from '@preact/signals';
import type { Answer } from '../server/api';
import type { Job, JobMotion } from '../server/messages';
import { motion_of_piece, read_trajectory, type Motion } from './motion';

const kMost = 64;
const kAtOnce = 4;

interface Known { key: string; motion: Motion | null }

export class MotionBook {
  private readonly known_ = new Map<string, Known>();
  private readonly waiting_: { id: string; key: string }[] = [];
  private asked_ = 0;
  private readonly changes_ = signal(0);

  constructor(private readonly fetch_: (id: string) => Promise<Answer<JobMotion>>) {}

  /** Changes when a trajectory arrives. */
  get changes(): ReadonlySignal<number> { return this.changes_; }

  /**
   * Returns the job's motion, or null if it is not loaded yet or the server no longer has it. After
   * a replan, returns the old motion until the new motion arrives.
   */
  of(job: Pick<Job, 'id' | 'duration_s' | 'planned' | 'arms'>): Motion | null {
    const key = `${job.duration_s} ${job.planned ?? ''} ${job.arms.join(' ')}`;
    const known = this.known_.get(job.id);
    if (known?.key !== key) this.ask(job.id, key, known?.motion ?? null);
    else {  // moves the entry to the end of the map, where the last used entries are
      this.known_.delete(job.id);
      this.known_.set(job.id, known);
    }
    return this.known_.get(job.id)?.motion ?? null;
  }

  /** Clears the cache, because another session may use the same ids for other jobs. */
  clear(): void {
    this.known_.clear();
    this.waiting_.length = 0;
  }

  private ask(id: string, key: string, before: Motion | null): void {
    this.known_.set(id, { key, motion: before });
    for (const oldest of this.known_.keys()) {
      if (this.known_.size <= kMost) break;
      this.known_.delete(oldest);
    }
    this.waiting_.push({ id, key });
    this.go_on();
  }

  private go_on(): void {
    while (this.asked_ < kAtOnce) {
      const next = this.waiting_.shift();
      if (!next) return;
      this.asked_ += 1;
      void this.fetch_(next.id).then((answer) => this.take(next.id, next.key, answer));
    }
  }

  private take(id: string, key: string, answer: Answer<JobMotion>): void {
    this.asked_ -= 1;
    const known = this.known_.get(id);
    const piece = answer.ok ? read_trajectory(answer.value.trajectory) : null;
    if (known?.key === key) {
      known.motion = piece ? motion_of_piece(piece) : null;
      untracked(() => { this.changes_.value += 1; });
    }
    this.go_on();
  }
}
