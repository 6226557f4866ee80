// The state that follows from the server's events, which are live or replayed: arms, jobs, objects,
// reports. Of the poses it has only those in snapshots.

import type { Arm, HeldObject, Job, SceneObject, SequencedMessage, Signal } from '../server/messages';
import { kText } from '../strings';
import { HaltBook, type Halts } from './halts';
import { is_terminal, JobBook, type JobList } from './job_book';
import { Notices, type Notice } from './notices';
import type { Snapshot } from './snapshots';
import { counted, kNoNumbers, type Numbers } from './numbers';
import { state_by_link, type ShownState } from './shown_state';

/**
 * A restart of the server. `at` is the wall time of the first message of the new session. `lost`
 * are the unfinished jobs of the old session that the new session does not contain.
 */
export interface Restart { at: string; lost: readonly Job[] }

const kAtRest: ReadonlySet<ShownState> = new Set(['paused', 'stopped', 'fault', 'link lost', 'connecting'] as const);

export class Facts {
  stream: string | null = null;
  policy = '';
  speed = 1;
  stopped = false;
  /** Speed override of the cell, 0 to 1. */
  speed_override = 1;
  t_s = 0;
  /**
   * The objects of the scene. Each change of the scene is a new array, which tells the 3D view to
   * draw them again.
   */
  objects: SceneObject[] = [];
  /** The objects that arms hold. They are not in `objects`. Each change is a new array. */
  held: HeldObject[] = [];
  /** The inputs and outputs, in the order of the cell file. */
  signals: Signal[] = [];
  arms = new Map<string, Arm>();
  q: Record<string, number> = {};
  /** The last restart of the server since the page was opened, until the user dismisses it. */
  restart: Restart | null = null;
  numbers: Numbers = kNoNumbers;
  readonly book = new JobBook();
  /** Arms whose state at the shown time is unknown. Empty unless this is a past state. */
  protected readonly unknown_arms_ = new Set<string>();
  protected readonly notices_ = new Notices();
  protected readonly halts_ = new HaltBook();

  apply(message: SequencedMessage): void {
    const same_run = message.stream === this.stream;
    const restarted = this.stream !== null && !same_run;
    this.t_s = Math.max(same_run ? this.t_s : 0, message.t_s);
    this.stream = message.stream;
    this.numbers = counted(this.numbers, message);
    if (restarted) this.halts_.clear();
    this.halts_.take(message);
    this.notices_.take(message);
    switch (message.type) {
      case 'snapshot':
        if (restarted) {
          const lost = this.book.open.filter(({ id }) => !message.data.jobs.some((job) => job.id === id));
          this.restart = { at: message.at, lost };
        }
        this.take_snapshot(message, same_run);
        if (restarted) this.notices_.note(this.stream, message.t_s, 'warning', kText.events.restarted);
        else if (message.data.gap) this.notices_.note(this.stream, message.t_s, 'info', kText.events.missed);
        break;
      case 'job':
        this.book.take(message.data, message.t_s);
        break;
      case 'arm':
        this.arms.set(message.data.name, message.data);
        this.unknown_arms_.delete(message.data.name);
        break;
      case 'queue':
        this.policy = message.data.policy ?? this.policy;
        this.stopped = message.data.stopped;
        this.speed_override = message.data.speed_override ?? 1;
        this.book.set_order(message.data);
        break;
      case 'scene':
        this.objects = message.data.objects;
        this.held = message.data.held;
        break;
      case 'io':
        this.signals = this.signals.map((known) => (known.name === message.data.name ? message.data : known));
        break;
    }
  }

  /** Reports, newest first. */
  get notices(): readonly Notice[] { return this.notices_.all; }

  /** Reports of this session. */
  get events(): readonly Notice[] { return this.notices_.of_run(this.stream); }

  get halts(): Halts { return this.halts_.all; }

  jobs(list: JobList): readonly Job[] {
    return this.book.list(list);
  }

  all_jobs(): Job[] {
    return this.book.all();
  }

  job(id: string): Job | null {
    return this.book.get(id);
  }

  is_terminal(job: Job): boolean {
    return is_terminal(job);
  }

  /**
   * Returns the progress of a job (0 to 1): the last reported progress, extrapolated while the job
   * runs. For a job with steps it is the share of the steps, because the server does not know how
   * long motions take that are not planned yet.
   */
  progress(job: Job): number {
    if (job.steps !== undefined) return share_of_steps(job);
    const heard_s = this.book.heard_at(job.id);
    const moves = job.state === 'running' && !this.arms_of(job).some((arm) => kAtRest.has(this.arm_state(arm)));
    if (heard_s === null || !moves || job.stopping || !job.duration_s) return job.progress;
    const since_report = Math.max(0, this.t_s - Math.max(heard_s, job.started_s ?? heard_s));
    const share = Math.min(1, ...job.arms.map((arm) => this.arms.get(arm)?.effective_speed_override ?? 1));
    return Math.min(1, job.progress + (since_report * share) / job.duration_s);
  }

  /** Returns the state of the arm as the page shows it. */
  arm_state(arm: Arm): ShownState {
    if (this.unknown_arms_.has(arm.name)) return 'not known';
    return state_by_link(arm) ?? (arm.state === 'idle' && this.waiting_of(arm.name) ? 'waiting' : arm.state);
  }

  /** Returns true if the job brakes. This is unknown, and false, if the link to an arm is lost. */
  is_braking(job: Job): boolean {
    return job.stopping && !this.arms_of(job).some(({ link }) => link === 'lost');
  }

  /**
   * Returns the job that has begun on an arm, or null. Between two motions of a job with steps the
   * arm itself names no job.
   */
  job_of({ name, job }: Pick<Arm, 'name' | 'job'>): Job | null {
    if (job !== null) return this.job(job);
    return this.jobs('running').find(({ steps, arms }) => steps !== undefined && arms.includes(name)) ?? null;
  }

  /** Returns the names of the objects that an arm holds. */
  holds(arm: string): string[] {
    return this.held.filter((one) => holders_of(one).includes(arm)).map(({ object }) => object.name);
  }

  /** Returns the arm's next job that has not started, or null. */
  next_of(arm: string): Job | null {
    for (const list of ['scheduled', 'backlog', 'queued'] as const) {
      const next = this.jobs(list).find((job) => job.arms.includes(arm));
      if (next) return next;
    }
    return null;
  }

  /** Returns the arm's next job if it waits, or null. */
  waiting_of(arm: string): Job | null {
    const next = this.next_of(arm);
    return next && (next.state === 'backlogged' || next.waits_on.length > 0) ? next : null;
  }

  /**
   * Returns the time since when the arm could have begun this job, which has not started: the job is
   * submitted, and the arm's last job has ended.
   */
  rests_since(job: Job): number {
    return Math.max(job.submitted_s, ...job.arms.map((arm) => this.book.free_since(arm)));
  }

  /**
   * Returns the number of unfinished jobs up to and including the first job that `job` waits for, on
   * the arms of that job. Null if `job` does not wait for a job of other arms to go first.
   */
  jobs_ahead({ waits_on: [first], arms }: Job): number | null {
    const before = first?.kind === 'predecessor' && first.id !== null ? this.job(first.id) : null;
    if (!before || is_terminal(before) || before.arms.some((arm) => arms.includes(arm))) return null;
    return 1 + this.book.open.filter((other) => other.id !== before.id && other.submitted_s <= before.submitted_s
      && this.book.is_ahead(other.id, before.id) && other.arms.some((arm) => before.arms.includes(arm))).length;
  }

  /**
   * Returns the measured positions of the arm's joints, in the arm's order. A joint without a
   * measurement has the position in the last arm event.
   */
  q_of(arm: Arm): number[] {
    return arm.joints.map((joint, i) => this.q[joint] ?? arm.q[i] ?? 0);
  }

  private arms_of({ arms }: Job): Arm[] {
    return arms.flatMap((name) => this.arms.get(name) ?? []);
  }

  private take_snapshot({ data, t_s }: Snapshot, same_run: boolean): void {
    this.policy = data.policy;
    this.speed = data.speed;
    this.stopped = data.stopped;
    this.speed_override = data.speed_override ?? 1;
    this.objects = data.objects;
    this.held = data.held ?? [];
    this.signals = data.io ?? [];
    // In a past state, arms that the snapshot does not contain stay, as unknown arms.
    this.arms = new Map([...(this.unknown_arms_.size > 0 ? this.arms : []), ...data.arms.map((arm) => [arm.name, arm] as const)]);
    for (const arm of data.arms) {
      this.unknown_arms_.delete(arm.name);
      this.place(arm);
    }
    this.book.reset(data.jobs, t_s, same_run, data.ended_from_s);
    this.book.set_order(data.queue);
  }

  private place(arm: Arm): void {
    arm.joints.forEach((joint, i) => {
      const angle = arm.q[i];
      if (angle !== undefined) this.q[joint] = angle;
    });
  }
}

/** Returns the share of a job's steps that are done, with the progress of the present motion. */
/** Returns the arms that hold the object. The first one carries it. */
export function holders_of({ arm, shared_with = [] }: HeldObject): string[] {
  return [arm, ...shared_with.map((other) => other.arm)];
}

function share_of_steps({ steps = [], step, result }: Job): number {
  const at = step ?? result?.step ?? steps.length;
  return steps.length === 0 ? 0 : (at + (steps[at]?.progress ?? 0)) / steps.length;
}
