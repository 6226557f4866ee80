// All that the page knows, in one place. Messages and replies go in through the methods; views read
// the fields, and three signals tell when to look again: `changes`, once per change; `frames`, with
// each pose (30 a second); `beats`, some times a second while poses come in.

import { signal, untracked, type ReadonlySignal } from '@preact/signals';
import type { Link } from '../server/connection';
import type { Arm, ArmAuthority, ArmState, Cell, Clearance, Forecast, Job, Message, SceneObject, SequencedMessage, StateMessage } from '../server/messages';
import { monitor_in_words } from '../wording';
import { outlook_of } from './outlook';
import { is_terminal, JobBook, remember, type JobList, type Stand } from './job_book';
import { Log } from './log';
import { ProgressBook } from './progress_book';
import { state_of, type ToldState } from './standing';
import { Trace } from './trace';

export interface Notice {
  key: number;
  /** Of the run of the server; null: said by this page. */
  stream: string | null;
  seq: number | null;
  t_s: number;
  level: 'info' | 'warning' | 'error';
  source: 'monitor' | 'alert';
  text: string;
  /** Those that it is about, where the server names them. */
  arms: readonly string[];
}

const kBeat_ms = 160;
const kMaxNotices = 100;
const kSilent_ms = 1000;
const kMissed_s = 0.5;
const kStands: ReadonlySet<ArmState> = new Set(['holding', 'stopped', 'fault'] as const);

export class Store {
  cell: Cell | null = null;
  cell_fault: string | null = null;
  link: Link = { status: 'connecting' };
  stream: string | null = null;
  policy = '';
  speed = 1;
  stopped = false;
  t_s = 0;
  /** Changes with every scene, so that the view draws objects again. */
  objects: SceneObject[] = [];
  arms = new Map<string, Arm>();
  q: Record<string, number> = {};
  clearance: Clearance[] = [];
  /** Of every arm that has been told to move. */
  motions: ArmAuthority[] = [];
  notices: Notice[] = [];
  rejected = { unknown: 0, malformed: 0 };
  /** The numbers of the events of this run: the last one, and how many were left out or came twice. */
  numbers = { last: 0, missed: 0, doubled: 0 };

  /** What the arms are expected to do, as far as that can be known; null: not known. */
  forecast: Forecast | null = null;
  readonly book = new JobBook();
  readonly trace: Trace;
  readonly courses: ProgressBook;
  /** When each arm was stopped, or at fault, whether it had a job or none. */
  readonly halts = new Map<string, Stand[]>();
  /** What earlier states are derived from. */
  readonly log = new Log(folded);
  /** Of these nothing was told until the time that is shown: only one that looks back has any. */
  readonly unknown_arms = new Set<string>();

  private next_key_ = 1;
  private readonly changes_ = signal(0);
  private readonly frames_ = signal(0);
  private readonly beats_ = signal(0);
  private beaten_at_ms_ = -Infinity;
  private quiet_ = false;
  private heard_at_ms_: number | null = null;

  /** `measured`: of another one, which it looks back into. */
  constructor(private readonly now_ms_: () => number = () => performance.now(), measured: { trace: Trace; courses: ProgressBook } | null = null) {
    this.trace = measured?.trace ?? new Trace();
    this.courses = measured?.courses ?? new ProgressBook();
  }

  get changes(): ReadonlySignal<number> { return this.changes_; }
  get frames(): ReadonlySignal<number> { return this.frames_; }
  get beats(): ReadonlySignal<number> { return this.beats_; }

  /** For what draws itself. The answer ends it. */
  on_change(listener: () => void): () => void {
    return from_now(this.changes_, listener);
  }

  on_frame(listener: () => void): () => void {
    return from_now(this.frames_, listener);
  }

  on_beat(listener: () => void): () => void {
    return from_now(this.beats_, listener);
  }

  take(message: Message): void {
    const silent_ms = this.silence_ms() ?? 0;
    this.heard_at_ms_ = this.now_ms_();
    if (message.type === 'state') {
      this.take_frame(message, silent_ms);
      return;
    }
    this.log.push(message);
    if (!this.quiet_) this.log.trim();
    this.apply(message);
  }

  /** One that is not to be remembered: of the log, gone through again. */
  apply(message: SequencedMessage): void {
    const same_run = message.stream === this.stream;
    const restarted = this.stream !== null && !same_run;
    this.t_s = Math.max(same_run ? this.t_s : 0, message.t_s);
    this.stream = message.stream;
    this.count(message.type === 'snapshot', message.seq);
    switch (message.type) {
      case 'snapshot': {
        const { data } = message;
        this.policy = data.policy;
        this.speed = data.speed;
        this.stopped = data.stopped;
        this.arms = new Map([...(this.unknown_arms.size > 0 ? this.arms : []), ...data.arms.map((arm) => [arm.name, arm] as const)]);
        for (const arm of data.arms) {
          this.place(arm);
          halt(this.halts, arm, message.t_s);
          this.unknown_arms.delete(arm.name);
        }
        this.book.reset(data.jobs, message.t_s, same_run);
        this.book.set_order(data.queue);
        if (!same_run) this.forecast = null;
        if (restarted) {
          this.trace.clear();
          this.courses.clear();
          this.halts.clear();
        }
        this.objects = data.objects;
        if (restarted) this.note(message.t_s, 'warning', 'alert', 'The server was restarted. Jobs of its former run are in the history, if it keeps them.');
        else if (data.gap) this.note(message.t_s, 'info', 'alert', 'Some events were missed while the connection was lost.');
        break;
      }
      case 'job':
        this.book.take(message.data, message.t_s);
        break;
      case 'arm':
        this.arms.set(message.data.name, message.data);
        halt(this.halts, message.data, message.t_s);
        this.unknown_arms.delete(message.data.name);
        break;
      case 'queue': {
        const { data } = message;
        this.policy = data.policy ?? this.policy;
        this.stopped = data.stopped;
        this.book.set_order(data);
        break;
      }
      case 'monitor':
      case 'alert': {
        const notice = this.notice_of(message);
        if (notice) this.keep(notice);
        break;
      }
      case 'scene':
        this.objects = message.data.objects;
        break;
    }
    this.changed();
  }

  /** Instead of the server's present; `forget_all` ends it. */
  show_recording(name: string, messages: readonly Message[], { names, t_s, q }: { names: readonly string[]; t_s: readonly number[]; q: readonly (readonly number[])[] }): void {
    const arms = [...this.arms.values()].map((arm) => ({ ...arm, state: 'idle' as const, job: null, progress: 0 }));
    this.forget_all();
    this.link = { status: 'recording', name };
    this.arms = new Map(arms.map((arm) => [arm.name, arm]));
    this.quiet_ = true;  // nobody looks at each of them
    const [begin] = messages;
    // It has all events of its run, which began with every arm idle.
    if (begin && begin.type !== 'state' && begin.seq === 1) this.log.push(this.beginning(begin, Math.min(begin.t_s, t_s[0] ?? 0), arms));
    for (const message of messages) this.take(message);
    this.quiet_ = false;
    this.trace.load(names, t_s, q);
    this.t_s = Math.max(this.t_s, t_s.at(-1) ?? 0);
    names.forEach((joint, i) => { this.q[joint] = q.at(-1)?.[i] ?? 0; });
    this.heard_at_ms_ = null;  // it is not old
    this.changed();
    this.frames_.value += 1;
    this.beats_.value += 1;
  }

  /** As before anything was heard; the cell stays. */
  forget_all(): void {
    this.link = { status: 'connecting' };
    this.stream = null;
    this.t_s = 0;
    this.stopped = false;
    this.notices = [];
    this.clearance = [];
    this.motions = [];
    this.forecast = null;
    this.book.reset([], 0, false);
    this.book.set_order(null);
    this.trace.clear();
    this.courses.clear();
    this.log.clear();
    this.halts.clear();
    this.heard_at_ms_ = null;
    this.changed();
  }

  /** Events of this run from before the first snapshot, which the page did not hear itself: in order, until it. */
  take_earlier(messages: readonly SequencedMessage[]): void {
    const [first] = this.log.entries;
    const fresh = messages.filter(({ stream, seq, type }) => type !== 'snapshot' && stream === this.stream && first?.stream === stream && seq <= first.seq);
    if (first?.type !== 'snapshot' || fresh.length === 0) return;
    this.log.put_before([before_all(first, fresh), ...fresh]);
    this.halts.clear();
    for (const message of this.log.entries) for (const arm of arms_of(message)) halt(this.halts, arm, message.t_s);
    const notices = fresh.flatMap((message) => this.notice_of(message) ?? []).reverse();
    this.notices = [...this.notices, ...notices].sort((a, b) => (a.stream === b.stream ? b.t_s - a.t_s : 0)).slice(0, kMaxNotices);
    this.changed();
  }

  /** This one looks back at what another has: until its log's events say more nothing is known of any arm. */
  begin_past(now: Store): void {
    this.cell = now.cell;
    this.link = now.link.status === 'recording' ? now.link : { status: 'past' };
    this.policy = now.policy;
    this.speed = now.speed;
    this.objects = now.objects;
    this.arms = new Map([...now.arms].map(([name, arm]) => [name, { ...arm, state: 'idle', job: null, progress: 0 }]));
    for (const name of this.arms.keys()) this.unknown_arms.add(name);
  }

  /** A time that no event lies between and the ones that it was made of. */
  look_at(t_s: number): void {
    this.t_s = t_s;
    this.beats_.value += 1;
  }


  set_cell(cell: Cell): void {
    this.cell = cell;
    this.cell_fault = null;
    if (!this.stream) {
      this.policy = cell.policy;
      this.speed = cell.speed;
      this.objects = cell.objects;
    }
    this.changed();
  }

  set_cell_fault(fault: string): void {
    this.cell_fault = fault;
    this.changed();
  }

  set_link(link: Link): void {
    this.link = link;
    if (link.status === 'lost') this.trace.break_off();
    this.changed();
  }

  /**
   * A job as it was fetched: it brings what events do not repeat while a job runs, its progress.
   * An event may have overtaken the answer, so one of another state than the known one is dropped.
   */
  refresh_job(job: Job): void {
    if (this.book.refresh(job, this.t_s)) this.changed();
  }

  set_forecast(forecast: Forecast | null): void {
    this.forecast = forecast && outlook_of(forecast);
    this.changed();
  }

  set_stopped(stopped: boolean): void {
    this.stopped = stopped;
    this.changed();
  }

  /** Counts it; answers whether it is the first of its kind, which is worth a line in the console. */
  reject(kind: 'unknown' | 'malformed'): boolean {
    this.rejected = { ...this.rejected, [kind]: this.rejected[kind] + 1 };
    this.changed();
    return this.rejected[kind] === 1;
  }

  /** Those of this run: times of another one are no times of it. */
  get events(): readonly Notice[] {
    return this.notices.filter(({ stream }) => stream === null || stream === this.stream);
  }

  jobs(list: JobList): readonly Job[] {
    return this.book.list(list);
  }

  all_jobs(): Job[] {
    return this.book.all();
  }

  job(id: string): Job | null {
    return this.book.get(id);
  }

  /** Share of its trajectory that a job has done by now: the last report, carried on while it runs. */
  progress(job: Job): number {
    const heard_s = this.book.heard_at(job.id);
    const moves = job.state === 'running' && job.arms.every((arm) => !kStands.has(this.arms.get(arm)?.state ?? 'moving'));
    if (heard_s === null || !moves || job.stopping || !job.duration_s) return job.progress;
    const since_report = Math.max(0, this.t_s - Math.max(heard_s, job.started_s ?? heard_s));
    return Math.min(1, job.progress + since_report / job.duration_s);
  }

  /** What an arm does, as people are told of it. */
  arm_state(arm: Arm): ToldState {
    if (this.unknown_arms.has(arm.name)) return 'not known';
    return state_of(arm, arm.job === null ? null : this.job(arm.job));
  }

  is_terminal(job: Job): boolean {
    return is_terminal(job);
  }

  /** The arm's configuration as last measured, in the order of its joints. */
  q_of(arm: Arm): number[] {
    return arm.joints.map((joint, i) => this.q[joint] ?? arm.q[i] ?? 0);
  }

  /** For how long nothing was heard; null before anything was. */
  silence_ms(): number | null {
    return this.heard_at_ms_ === null ? null : this.now_ms_() - this.heard_at_ms_;
  }

  private take_frame(frame: StateMessage, silent_ms: number): void {
    // Frames may be lost on the way. A page that was busy itself hears all of them, late.
    if (silent_ms > kSilent_ms && frame.t_s - (this.trace.last_s ?? frame.t_s) > kMissed_s) this.trace.break_off();
    this.t_s = frame.t_s;
    Object.assign(this.q, frame.q);
    this.clearance = frame.clearance;
    this.motions = frame.motions;
    this.trace.push(frame.t_s, frame.q);
    this.courses.take(frame.t_s, frame.motions);
    this.frames_.value += 1;
    const now_ms = this.now_ms_();
    if (now_ms - this.beaten_at_ms_ < kBeat_ms) return;
    this.beaten_at_ms_ = now_ms;
    this.beats_.value += 1;
  }

  /** A snapshot holds all until its number. */
  private count(is_snapshot: boolean, seq: number): void {
    const { last, missed, doubled } = this.numbers;
    if (is_snapshot) this.numbers = { last: seq, missed: 0, doubled: 0 };
    else if (seq > last) this.numbers = { last: seq, missed: missed + seq - last - 1, doubled };
    else this.numbers = { last, missed, doubled: doubled + 1 };
  }

  private beginning({ stream, at }: SequencedMessage, t_s: number, arms: Arm[]): SequencedMessage {
    const queue = { stopped: false, queued: [], backlog: [], scheduled: [], running: [] };
    const objects = this.cell?.objects ?? this.objects;
    return { stream, at, seq: 0, type: 'snapshot', t_s, data: { cell: this.cell?.name ?? '', policy: this.policy, speed: this.speed, stopped: false, arms, jobs: [], queue, objects } };
  }

  private place(arm: Arm): void {
    arm.joints.forEach((joint, i) => {
      const angle = arm.q[i];
      if (angle !== undefined) this.q[joint] = angle;
    });
  }

  private notice_of(message: SequencedMessage): Notice | null {
    const common = { key: this.next_key_++, stream: message.stream, seq: message.seq, t_s: message.t_s };
    switch (message.type) {
      case 'monitor': {
        const { data } = message;
        return { ...common, level: data.stopped.length ? 'error' : 'warning', source: 'monitor', text: monitor_in_words(data), arms: data.arms };
      }
      case 'alert': return { ...common, level: message.data.level, source: 'alert', text: message.data.text, arms: [] };
      default: return null;
    }
  }

  private note(t_s: number, level: Notice['level'], source: Notice['source'], text: string): void {
    this.keep({ key: this.next_key_++, stream: this.stream, seq: null, t_s, level, source, text, arms: [] });
  }

  private keep(notice: Notice): void {
    this.notices = [notice, ...this.notices].slice(0, kMaxNotices);
  }

  private changed(): void {
    if (!this.quiet_) this.changes_.value += 1;
  }
}

function arms_of(message: SequencedMessage): readonly Arm[] {
  return message.type === 'arm' ? [message.data] : message.type === 'snapshot' ? message.data.arms : [];
}

function halt(halts: Map<string, Stand[]>, { name, state }: Arm, t_s: number): void {
  const known = halts.get(name) ?? [];
  const last = known.at(-1);
  const is_halted = state === 'stopped' || state === 'fault';
  if (is_halted === (last?.to_s === null)) return;
  if (last && !is_halted) last.to_s = t_s;
  if (is_halted) remember(known, { from_s: t_s, to_s: null, stopped: true });
  halts.set(name, known);
}

/** What all these come to, as one snapshot; null: none of them is one, so that it would be a guess. */
function folded(entries: readonly SequencedMessage[]): SequencedMessage | null {
  const [first, last] = [entries[0], entries.at(-1)];
  if (first?.type !== 'snapshot' || !last) return null;
  const store = new Store();
  for (const message of entries) store.apply(message);
  return {
    stream: last.stream, seq: last.seq, type: 'snapshot', t_s: last.t_s, at: last.at,
    data: {
      cell: first.data.cell, policy: store.policy, speed: store.speed, stopped: store.stopped, arms: [...store.arms.values()],
      jobs: store.all_jobs(), queue: store.book.order, objects: store.objects,
    },
  };
}

/** What held before these, which led to the snapshot: whatever they do not tell of is as it was then. */
function before_all({ data, ...first }: Extract<SequencedMessage, { type: 'snapshot' }>, led: readonly SequencedMessage[]): SequencedMessage {
  const arms = new Set(led.flatMap((message) => (message.type === 'arm' ? [message.data.name] : [])));
  const jobs = new Set(led.flatMap((message) => (message.type === 'job' ? [message.data.id] : [])));
  const [next] = led;
  // From the very beginning, when every arm stood idle.
  const is_whole = next?.seq === 1;
  const idle = data.arms.map((arm) => (arms.has(arm.name) ? { ...arm, state: 'idle' as const, job: null, progress: 0 } : arm));
  return {
    ...first, type: 'snapshot', seq: (next?.seq ?? 1) - 1, t_s: is_whole ? 0 : next?.t_s ?? first.t_s, at: next?.at ?? first.at,
    data: {
      ...data, gap: false, stopped: false, arms: is_whole ? idle : data.arms.filter(({ name }) => !arms.has(name)),
      jobs: data.jobs.filter(({ id }) => !jobs.has(id)),
    },
  };
}

/** A signal tells its value at once, too, which a listener here has seen. */
function from_now(changes: ReadonlySignal<number>, listener: () => void): () => void {
  let first = true;
  return changes.subscribe(() => {
    if (!first) untracked(listener);
    first = false;
  });
}
