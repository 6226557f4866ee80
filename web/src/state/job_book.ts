// The jobs that the page knows. For each job it has the last message, the time since when the job
// is in its state, and the pauses; for all jobs the server's order. Ended jobs are kept sorted by
// their end, so that an update is cheap even with ten thousand ended jobs.

import type { Job, JobState, QueueData, WaitsOn } from '../server/messages';
import { is_stopped, shown_state } from './shown_state';

export type JobList = 'running' | 'scheduled' | 'queued' | 'backlog' | 'finished';

const kListOfState: Record<JobState, JobList> = {
  running: 'running', paused: 'running', scheduled: 'scheduled', queued: 'queued', backlogged: 'backlog',
  succeeded: 'finished', canceled: 'finished', expired: 'finished', failed: 'finished', interrupted: 'finished',
};
const kMaxFinished = 10_000;
// The largest number of ended jobs in a snapshot (see the schema of snapshots).
const kTold = 200;
// Ended jobs are dropped in blocks. A block is this share of the jobs that are kept.
const kSlack = 0.05;
// The largest number of pauses, and of changes, that are kept for one job.
const kMostRemembered = 400;

export function is_terminal(job: Pick<Job, 'state'>): boolean {
  return kListOfState[job.state] === 'finished';
}

/**
 * A pause of a job, in cell time. `to_s` is null while the pause lasts. If `stopped`, the pause
 * lasts until the arm is resumed. `why` is the last known reason.
 */
export interface Pause { from_s: number; to_s: number | null; stopped: boolean; why: WaitsOn | null }

/** A change of a job's state. `stopped` means that the job is at rest until its arm is resumed. */
export interface Change { state: JobState | 'stopped'; t_s: number }

/** The cell time at which a step of a job became the present step. */
export interface StepChange { step: number; t_s: number }

interface Heard {
  job: Job;
  /** Cell time of the last message about the job. */
  t_s: number;
  /**
   * The time since when the job is in its state. Null if it was so before the page was connected.
   */
  since_s: number | null;
  pauses: Pause[];
  /** The state changes since the page was connected. */
  changes: Change[];
  /** The changes of the present step since the page was connected, if the job has steps. */
  steps: StepChange[];
}

export class JobBook {
  private heard_ = new Map<string, Heard>();
  /** The ids of unfinished jobs. */
  private open_ = new Set<string>();
  /** Ended jobs, oldest first. */
  private ended_: Job[] = [];
  private order_ = new Map<string, number>();
  private lists_: Map<JobList, Job[]> | null = null;
  private endings_ = 0;
  private ended_from_s_: number | null = null;

  constructor(private readonly most_finished_ = kMaxFinished) {}

  /**
   * Replaces all jobs by those of a snapshot. Pauses and changes of jobs in the same session are
   * kept. `ended_from_s` is given by snapshots that the page made itself.
   */
  reset(jobs: readonly Job[], t_s: number, same_run: boolean, ended_from_s?: number | null): void {
    const before = same_run ? this.heard_ : new Map<string, Heard>();
    this.heard_ = new Map(jobs.map((job) => {
      const known = before.get(job.id);
      const same_state = known?.job.state === job.state;
      const pauses = known?.pauses ?? [];
      const steps = known?.steps ?? [];
      note_pause(pauses, job, t_s);
      note_step(steps, known?.job, job, t_s);
      return [job.id, { job, t_s, since_s: same_state ? known.since_s : null, pauses, changes: known?.changes ?? [], steps }];
    }));
    this.open_ = new Set(jobs.filter((job) => !is_terminal(job)).map((job) => job.id));
    this.ended_ = jobs.filter(is_terminal).sort((a, b) => ended(a) - ended(b));
    this.ended_from_s_ = ended_from_s === undefined ? ended_from(jobs) : ended_from_s;
    this.endings_ += 1;
    this.lists_ = null;
  }

  /**
   * Takes the pauses, the changes, the steps and the times of states from a book that has read more of the
   * session's events than this book, up to the same event.
   */
  learn_history(longer: JobBook): void {
    for (const [id, heard] of this.heard_) {
      const other = longer.heard_.get(id);
      if (other) this.heard_.set(id, { ...heard, since_s: other.since_s, pauses: other.pauses, changes: other.changes, steps: other.steps });
    }
    this.endings_ += 1;
  }

  take(job: Job, t_s: number): void {
    const known = this.heard_.get(job.id);
    const same_state = known?.job.state === job.state;
    const pauses = known?.pauses ?? [];
    const changes = known?.changes ?? [];
    const shown = shown_state(job);
    if (changes.at(-1)?.state !== shown && (!same_state || shown_state(known.job) !== shown)) remember(changes, { state: shown, t_s });
    const steps = known?.steps ?? [];
    note_pause(pauses, job, t_s);
    note_step(steps, known?.job, job, t_s);
    this.heard_.set(job.id, { job, t_s, since_s: same_state ? known.since_s : t_s, pauses, changes, steps });
    if (known && is_terminal(known.job)) {
      this.ended_ = this.ended_.filter((one) => one.id !== job.id);
      this.endings_ += 1;
    }
    if (is_terminal(job)) this.end(job);
    else this.open_.add(job.id);
    this.lists_ = null;
  }

  /**
   * Takes a polled job, because only a polled job has its present progress. Returns false and drops
   * the job if its state differs from the known state.
   */
  refresh(job: Job, t_s: number): boolean {
    const known = this.heard_.get(job.id);
    if (!known || known.job.state !== job.state || is_terminal(known.job)) return false;
    note_step(known.steps, known.job, job, t_s);
    this.heard_.set(job.id, { ...known, job, t_s });
    this.lists_ = null;
    return true;
  }

  set_order(queue: QueueData | null): void {
    const ids = queue ? [...queue.running, ...queue.scheduled, ...queue.queued, ...queue.backlog] : [];
    this.order_ = new Map(ids.map((id, i) => [id, i]));
    this.lists_ = null;
  }

  /** The server's lists of unfinished jobs, in order. */
  get order(): QueueData {
    const ids = (list: JobList) => this.list(list).map(({ id }) => id);
    return { stopped: false, running: ids('running'), scheduled: ids('scheduled'), queued: ids('queued'), backlog: ids('backlog') };
  }

  get(id: string): Job | null {
    return this.heard_.get(id)?.job ?? null;
  }

  heard_at(id: string): number | null {
    return this.heard_.get(id)?.t_s ?? null;
  }

  since(id: string): number | null {
    return this.heard_.get(id)?.since_s ?? null;
  }

  changes(id: string): readonly Change[] {
    return this.heard_.get(id)?.changes ?? [];
  }

  pauses(id: string): readonly Pause[] {
    return this.heard_.get(id)?.pauses ?? [];
  }

  /** Returns when each step of a job began, as far as the page knows. */
  steps(id: string): readonly StepChange[] {
    return this.heard_.get(id)?.steps ?? [];
  }

  all(): Job[] {
    return [...this.heard_.values()].map((heard) => heard.job);
  }

  /** The unfinished jobs. */
  get open(): Job[] {
    return [...this.open_].flatMap((id) => this.get(id) ?? []);
  }

  has_ended(id: string): boolean {
    return this.heard_.has(id) && !this.open_.has(id);
  }

  /** A number that changes whenever the ended jobs change, or their history. */
  get endings(): number {
    return this.endings_;
  }

  /**
   * All jobs of the session that ended at this time or later are known. Null if all ended jobs of
   * the session are known.
   */
  get ended_from_s(): number | null {
    return this.ended_from_s_;
  }

  /** Returns the jobs that ended at a time or later, newest first. */
  ended_since(t_s: number): Job[] {
    const jobs: Job[] = [];
    for (let i = this.ended_.length - 1; i >= 0; i--) {
      const job = this.ended_[i];
      if (!job || ended(job) < t_s) break;
      jobs.push(job);
    }
    return jobs;
  }

  /** Returns the end of the arm's last ended job, or 0 if the page knows none. */
  free_since(arm: string): number {
    for (let i = this.ended_.length - 1; i >= 0; i--) {
      const job = this.ended_[i];
      if (job && job.started_s !== null && job.arms.includes(arm)) return ended(job);
    }
    return 0;
  }

  /** Returns true if an unfinished job comes before another in the server's lists. */
  is_ahead(id: string, other: string): boolean {
    const [a, b] = [this.order_.get(id), this.order_.get(other)];
    return a !== undefined && (b === undefined || a < b);
  }

  /**
   * Returns the jobs of a list, in the server's order. Ended jobs are newest first. The caller must
   * not change the list.
   */
  list(list: JobList): readonly Job[] {
    this.lists_ ??= this.sorted();
    return this.lists_.get(list) ?? [];
  }

  private sorted(): Map<JobList, Job[]> {
    const lists = new Map<JobList, Job[]>([['finished', [...this.ended_].reverse()]]);
    for (const id of this.open_) {
      const job = this.get(id);
      if (!job) continue;
      const name = kListOfState[job.state];
      const list = lists.get(name);
      if (list) list.push(job);
      else lists.set(name, [job]);
    }
    const place = (job: Job) => this.order_.get(job.id) ?? Infinity;
    for (const [name, jobs] of lists) {
      if (name !== 'finished') jobs.sort((a, b) => (place(a) - place(b)) || a.submitted_s - b.submitted_s);
    }
    return lists;
  }

  /**
   * Adds an ended job to the sorted list. The search begins at the end, because jobs usually arrive
   * in the order of their ends.
   */
  private end(job: Job): void {
    this.open_.delete(job.id);
    this.endings_ += 1;
    let at = this.ended_.length;
    while (at > 0 && ended(this.ended_[at - 1]) > ended(job)) at -= 1;
    this.ended_.splice(at, 0, job);
    if (this.ended_.length <= this.most_finished_ * (1 + kSlack)) return;
    for (const old of this.ended_.splice(0, this.ended_.length - this.most_finished_)) this.heard_.delete(old.id);
    this.ended_from_s_ = ended(this.ended_[0]);
  }
}

/**
 * Returns the time since when the ended jobs of a server snapshot are complete. Null if they are
 * complete for the session.
 */
export function ended_from(jobs: readonly Job[]): number | null {
  const ended_s = jobs.filter(is_terminal).map(ended);
  return ended_s.length < kTold ? null : Math.min(...ended_s);
}

/** Records that a job pauses, continues, or pauses for a new reason. */
function note_pause(pauses: Pause[], job: Job, t_s: number): void {
  const last = pauses.at(-1);
  const open = last && last.to_s === null ? last : null;
  const stopped = is_stopped(job);
  const why = job.waits_on[0] ?? null;
  if (open && job.state === 'paused' && open.stopped === stopped) {
    open.why = why ?? open.why;
    return;
  }
  if (open) open.to_s = job.ended_s ?? t_s;
  if (job.state === 'paused') remember(pauses, { from_s: t_s, to_s: null, stopped, why });
}

/**
 * Records that a job has begun, or has another present step. If nothing was known of the job
 * before, the time at which its present step began is not known.
 */
function note_step(steps: StepChange[], known: Job | undefined, job: Job, t_s: number): void {
  if (job.step === undefined || job.started_s === null || known === undefined) return;
  if (known.started_s === null) remember(steps, { step: job.step, t_s: job.started_s });
  else if (known.step !== job.step) remember(steps, { step: job.step, t_s });
}

export function remember<T>(list: T[], one: T): void {
  list.push(one);
  if (list.length > kMostRemembered) list.splice(0, list.length - kMostRemembered);
}

function ended(job: Job | undefined): number {
  return job?.ended_s ?? 0;
}
