// Jobs that the server has and the page was never told of: of its former runs, and those that it told of
// long ago. They are fetched a page at a time, when somebody asks for more, newest first. Their cell times
// are of the run that they ended in; only the wall clock is common to all.

import { signal } from '@preact/signals';
import type { Answer, Api } from '../server/api';
import type { Job, Problem } from '../server/messages';

const kPage = 1000;  // the server's most: somebody waits for what is asked for

export class Archive {
  private readonly jobs_ = signal<ReadonlyMap<string, Job>>(new Map());
  private readonly state_ = signal<'more' | 'asking' | 'all'>('more');
  private readonly fault_ = signal<Problem | null>(null);
  private cursor_: string | null = null;
  /** What was asked of another run of the server is no answer any more. */
  private turn_ = 0;
  private readonly asked_ = new Map<string, Promise<Answer<Job>>>();

  /** `knows`: those that the page is told of. */
  constructor(private readonly api_: Pick<Api, 'jobs' | 'job'>, private readonly knows_: (id: string) => boolean) {}

  /** Whether there may be more of them. */
  get state(): 'more' | 'asking' | 'all' { return this.state_.value; }
  get fault(): Problem | null { return this.fault_.value; }

  /** Newest first. */
  get jobs(): Job[] {
    return [...this.jobs_.value.values()].filter(({ id }) => !this.knows_(id));
  }

  get(id: string): Job | null {
    return this.jobs_.value.get(id) ?? null;
  }

  /** Goes on until there is at least one that is new, or no more. */
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
      // A page that leads nowhere else is the last one.
      if (next_cursor === null || next_cursor === this.cursor_) {
        this.state_.value = 'all';
        return;
      }
      this.cursor_ = next_cursor;
    }
    this.state_.value = 'more';
  }

  /** One of them, by its id: asked for once. */
  async find(id: string): Promise<void> {
    if (this.get(id) !== null || this.asked_.has(id)) return;
    const turn = this.turn_;
    const asked = this.api_.job(id);
    this.asked_.set(id, asked);
    const answer = await asked;
    if (turn === this.turn_ && answer.ok) this.keep([answer.value]);
  }

  /** The page is not told any more of all that it was: what it has not is asked for again. */
  reopen(): void {
    this.turn_ += 1;
    this.cursor_ = null;
    this.state_.value = 'more';
    this.fault_.value = null;
  }

  /** Another run of the server: what it has is asked for anew. */
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
