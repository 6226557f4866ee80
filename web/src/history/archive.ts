// Ended jobs that the page did not receive as events: jobs of previous sessions, and old jobs of
// this session. They are loaded page by page when the user asks, newest first. The cell times of
// jobs of different sessions cannot be compared; only their wall-clock times can.

import { signal } from '@preact/signals';
import type { Answer, Api } from '../server/api';
import type { Job, Problem } from '../server/messages';

const kPage = 1000;  // jobs per request: the server's maximum, because the user waits for each answer

export class Archive {
  private readonly jobs_ = signal<ReadonlyMap<string, Job>>(new Map());
  private readonly state_ = signal<'more' | 'asking' | 'all'>('more');
  private readonly fault_ = signal<Problem | null>(null);
  private cursor_: string | null = null;
  /** Grows whenever loading starts again. Answers to earlier requests are then dropped. */
  private turn_ = 0;
  private readonly asked_ = new Map<string, Promise<Answer<Job>>>();

  /** `knows` returns true for a job that the page received as an event. */
  constructor(private readonly api_: Pick<Api, 'jobs' | 'job'>, private readonly knows_: (id: string) => boolean) {}

  /** Says whether the server may have more jobs. */
  get state(): 'more' | 'asking' | 'all' { return this.state_.value; }
  get fault(): Problem | null { return this.fault_.value; }

  /** Newest first. */
  get jobs(): Job[] {
    return [...this.jobs_.value.values()].filter(({ id }) => !this.knows_(id));
  }

  get(id: string): Job | null {
    return this.jobs_.value.get(id) ?? null;
  }

  /** Loads pages until at least one job is new or no page is left. */
  async more(): Promise<void> {
    if (this.state_.peek() !== 'more') return;
    const turn = this.turn_;
    this.state_.value = 'asking';
    this.fault_.value = null;
    for (let found = 0; found === 0;) {
      const answer = await this.api_.jobs(kPage, this.cursor_);
      if (turn !== this.turn_) return;
      if (!answer.ok) {
        this.fault_.value = answer.problem;
        this.state_.value = 'more';
        return;
      }
      const { jobs, next_cursor } = answer.value;
      found = this.keep(jobs.filter((job) => job.result !== null && !this.knows_(job.id)));
      // The last page has no cursor, or the cursor of the page before.
      if (next_cursor === null || next_cursor === this.cursor_) {
        this.state_.value = 'all';
        return;
      }
      this.cursor_ = next_cursor;
    }
    this.state_.value = 'more';
  }

  /** Loads one job by its id, at most once. */
  async find(id: string): Promise<void> {
    if (this.get(id) !== null || this.asked_.has(id)) return;
    const turn = this.turn_;
    const asked = this.api_.job(id);
    this.asked_.set(id, asked);
    const answer = await asked;
    if (turn === this.turn_ && answer.ok) this.keep([answer.value]);
  }

  /**
   * Starts again from the newest job. Needed after a snapshot, which drops jobs that the page knew.
   */
  reopen(): void {
    this.turn_ += 1;
    this.cursor_ = null;
    this.state_.value = 'more';
    this.fault_.value = null;
  }

  /** Forgets everything, because another server session has begun. */
  forget(): void {
    this.reopen();
    this.asked_.clear();
    this.jobs_.value = new Map();
  }

  private keep(jobs: readonly Job[]): number {
    const before = this.jobs_.peek();
    const fresh = jobs.filter(({ id }) => !before.has(id));
    if (fresh.length > 0) this.jobs_.value = new Map([...before, ...fresh.map((job) => [job.id, job] as const)].sort(([, a], [, b]) => compare(ended(b), ended(a))));
    return fresh.length;
  }
}

function ended(job: Job): string {
  return job.ended_at ?? job.submitted_at;
}

function compare(a: string, b: string): number {
  return a < b ? -1 : a > b ? 1 : 0;
}
