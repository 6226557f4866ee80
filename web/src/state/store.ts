// All that the page knows: the state from events (Facts), poses, the history of both, and the
// connection. Messages enter through methods. Views read the members and are redrawn by the signals
// of state/pulse.ts.

import type { Link } from '../server/connection';
import type { ArmAuthority, Cell, Clearance, Forecast, Job, MeasuredStates, Message, SequencedMessage, StateMessage } from '../server/messages';
import { Facts } from './facts';
import { Log } from './log';
import { ProgressBook, progress_at } from './progress_book';
import { from_now, Pulse } from './pulse';
import { at_rest, before_all, beginning_of, folded } from './snapshots';
import { Trace } from './trace';

/** The joint positions of a recording. */
export interface Frames { names: readonly string[]; t_s: readonly number[]; q: readonly (readonly number[])[] }

// Data that arrives less late than this is not reported as old, because a busy page may be a few
// seconds late.
const kLate_ms = 5_000;
const kSilent_ms = 1000;
const kMissed_s = 0.5;
// If more messages wait for a redraw than this, they are applied at once: a hidden page is rarely drawn.
const kMostWaiting = 2000;

export class Store extends Facts {
  cell: Cell | null = null;
  cell_fault: string | null = null;
  link: Link = { status: 'connecting' };
  clearance: Clearance[] = [];
  /** The progress and authority of every arm that has been told to move, in each of its motions. */
  motions: ArmAuthority[] = [];
  rejected = { unknown: 0, malformed: 0 };
  /** The timeline that the server predicts, or null if unknown. */
  forecast: Forecast | null = null;
  readonly trace: Trace;
  readonly courses: ProgressBook;
  /** The log of events, from which past states are derived. */
  readonly log = new Log(folded);

  private readonly pulse_: Pulse;
  private late_ms_ = 0;
  private heard_at_ms_: number | null = null;
  private earlier_states_: MeasuredStates | null = null;
  private waiting_: (() => void)[] = [];
  /** The time at which views show progress: that of the last beat or change. */
  private moment_s_ = 0;

  /** `measured` are the trace and the progress of another store, which a past state shares. */
  constructor(private readonly now_ms_: () => number = () => performance.now(), measured: { trace: Trace; courses: ProgressBook } | null = null) {
    super();
    this.pulse_ = new Pulse(now_ms_);
    this.trace = measured?.trace ?? new Trace();
    this.courses = measured?.courses ?? new ProgressBook();
  }

  get changes() { return this.pulse_.changes; }
  get frames() { return this.pulse_.frames; }
  get beats() { return this.pulse_.beats; }

  /** Calls the listener on each later change. The returned function removes the listener. */
  on_change(listener: () => void): () => void {
    return from_now(this.changes, listener);
  }
  on_frame(listener: () => void): () => void {
    return from_now(this.frames, listener);
  }
  on_beat(listener: () => void): () => void {
    return from_now(this.beats, listener);
  }

  on_arrival(listener: () => void): () => void {
    return from_now(this.pulse_.arrivals, listener);
  }

  /**
   * Takes an event at the next redraw (collect()), so that no view shows it before the others. A pose
   * is taken at once if no event waits. `take` replaces this store's take().
   */
  receive(message: Message, take: (message: Message) => void = (one) => this.take(one)): void {
    if (message.type === 'state' && this.waiting_.length === 0) return take(message);
    this.waiting_.push(() => take(message));
    if (this.waiting_.length > kMostWaiting) this.collect();
    else this.pulse_.arrive();
  }

  /** Takes all messages that wait, in order. */
  collect(): void {
    for (const take of this.waiting_.splice(0)) take();
    this.moment_s_ = this.t_s;
  }

  take(message: Message): void {
    const silent_ms = this.silence_ms() ?? 0;
    this.heard_at_ms_ = this.now_ms_();
    if (message.type === 'state') {
      this.take_frame(message, silent_ms);
      return;
    }
    this.log.push(message);
    if (!this.pulse_.is_quiet) this.log.trim();
    this.apply(message);
  }

  /** Applies an event that is already in the log, for replays. */
  override apply(message: SequencedMessage): void {
    const before = this.stream;
    super.apply(message);
    if (before !== message.stream) this.begin_run(before !== null);
    this.pulse_.change();
  }

  /**
   * Shows a recording instead of the live cell, until forget_all(). If `frames` is null, the
   * recording has no positions.
   */
  show_recording(name: string, messages: readonly SequencedMessage[], frames: Frames | null): void {
    const arms = [...this.arms.values()].map(at_rest);
    const { names, t_s, q } = frames ?? { names: [], t_s: [], q: [] };
    this.forget_all();
    this.link = { status: 'recording', name };
    this.arms = new Map(arms.map((arm) => [arm.name, arm]));
    this.pulse_.at_once(() => {
      const [begin] = messages;
      // If the recording has all events of its session, it begins with every arm idle.
      if (begin?.seq === 1) this.log.push(beginning_of(begin, Math.min(begin.t_s, t_s[0] ?? 0), { cell: this.cell?.name ?? '', policy: this.policy, speed: this.speed, arms, objects: this.cell?.objects ?? this.objects }));
      for (const message of messages) this.take(message);
      this.trace.load(names, t_s, q);
      this.t_s = Math.max(this.t_s, t_s.at(-1) ?? 0);
      this.q = Object.fromEntries(names.map((joint, i) => [joint, q.at(-1)?.[i] ?? 0]));
      this.heard_at_ms_ = null;  // the data of a recording never counts as old
    });
  }

  /**
   * The range of cell times that can be shown: the times of the positions. For a recording without
   * positions it is the times of the events.
   */
  get span(): { first_s: number; last_s: number } | null {
    const { first_s, last_s } = this.trace;
    if (first_s !== null && last_s !== null) return { first_s, last_s };
    const [first, last] = [this.log.entries[0], this.log.entries.at(-1)];
    return this.link.status === 'recording' && first && last ? { first_s: first.t_s, last_s: last.t_s } : null;
  }

  /**
   * Forgets the session: jobs, events, the trace, and the state of the connection. Keeps the cell
   * with its arms and objects.
   */
  forget_all(): void {
    this.waiting_ = [];
    this.link = { status: 'connecting' };
    this.stream = null;
    this.t_s = 0;
    this.stopped = false;
    this.restart = null;
    this.held = [];
    this.clearance = [];
    this.motions = [];
    this.forecast = null;
    this.book.reset([], 0, false);
    this.book.set_order(null);
    this.trace.clear();
    this.courses.clear();
    this.log.clear();
    this.notices_.clear();
    this.halts_.clear();
    this.heard_at_ms_ = null;
    this.earlier_states_ = null;
    this.pulse_.change();
  }

  /** Inserts events of this session from before the first snapshot. They must be in order. */
  take_earlier(messages: readonly SequencedMessage[]): void {
    const [first] = this.log.entries;
    const fresh = messages.filter(({ stream, seq, type }) => type !== 'snapshot' && stream === this.stream && first?.stream === stream && seq <= first.seq);
    if (first?.type !== 'snapshot' || fresh.length === 0) return;
    this.log.put_before([before_all(first, fresh), ...fresh]);
    this.read_history();
    this.notices_.take_earlier(fresh);
    this.pulse_.change();
  }

  /**
   * Derives the pauses and stops from all events of the log, as if the page had been connected since
   * the first of them.
   */
  private read_history(): void {
    const facts = new Facts();
    this.halts_.clear();
    for (const message of this.log.entries) {
      facts.apply(message);
      this.halts_.take(message);
    }
    this.book.learn_history(facts.book);
  }

  /**
   * Takes positions from before the page was connected, or from while the connection was lost. They
   * are inserted when the next frame arrives, because that frame marks where the page's own data
   * continues.
   */
  take_earlier_states(states: MeasuredStates): void {
    this.earlier_states_ = states;
  }

  /**
   * Makes this store a past state of the store `now`. The state of every arm is unknown until an
   * event mentions the arm.
   */
  begin_past(now: Store): void {
    this.cell = now.cell;
    this.link = now.link.status === 'recording' ? now.link : { status: 'past' };
    this.policy = now.policy;
    this.speed = now.speed;
    this.objects = now.objects;
    this.signals = now.signals;
    this.arms = new Map([...now.arms].map(([name, arm]) => [name, at_rest(arm)]));
    for (const name of this.arms.keys()) this.unknown_arms_.add(name);
  }

  /**
   * Returns the progress of a job (0 to 1) for all views: the measured progress if frames have it,
   * else as Facts does. `job` may be older than the store.
   */
  override progress(job: Job): number {
    const now = this.job(job.id) ?? job;
    const moves = now.state === 'running' || now.state === 'paused';
    const course = moves && now.duration_s > 0 ? this.courses.of(now.id) : null;
    const progress_s = course && progress_at(course, Math.max(this.moment_s_, now.started_s ?? 0));
    return progress_s === null ? super.progress(now) : Math.min(1, progress_s / now.duration_s);
  }

  /** Sets the shown time. No event may lie between it and the last applied event. */
  look_at(t_s: number): void {
    this.t_s = this.moment_s_ = t_s;
    this.pulse_.beat();
  }

  set_cell(cell: Cell): void {
    this.cell = cell;
    this.cell_fault = null;
    if (!this.stream) {
      this.policy = cell.policy;
      this.speed = cell.speed;
      this.objects = cell.objects;
    }
    this.pulse_.change();
  }

  set_cell_fault(fault: string): void {
    this.cell_fault = fault;
    this.pulse_.change();
  }

  set_link(link: Link): void {
    this.collect();
    this.link = link;
    if (link.status === 'lost') this.trace.break_off();
    this.pulse_.change();
  }

  /**
   * Takes a polled job, because only a polled job has its present progress. If an event has changed
   * the state of the job before the answer arrived, the polled job is dropped.
   */
  refresh_job(job: Job): void {
    if (this.book.refresh(job, this.t_s)) this.pulse_.change();
  }

  set_forecast(forecast: Forecast | null): void {
    this.forecast = forecast;
    // The forecast does not wait behind messages that are still on their way to the page. So it
    // shows how late they are.
    this.late_ms_ = forecast === null ? 0 : Math.max(0, (1000 * (forecast.now_s - this.t_s)) / this.speed);
    this.pulse_.change();
  }

  dismiss_restart(): void {
    this.restart = null;
    this.pulse_.change();
  }

  set_stopped(stopped: boolean): void {
    this.stopped = stopped;
    this.pulse_.change();
  }

  /**
   * Counts a rejected message. Returns true for the first message of its kind, which the caller
   * reports in the console.
   */
  reject(kind: 'unknown' | 'malformed'): boolean {
    this.rejected = { ...this.rejected, [kind]: this.rejected[kind] + 1 };
    this.pulse_.change();
    return this.rejected[kind] === 1;
  }

  /**
   * Returns the age of the data, which is the silence or the delay. Null before the first message.
   */
  age_ms(): number | null {
    const silent_ms = this.silence_ms();
    return silent_ms === null ? null : Math.max(silent_ms, this.late_ms_ > kLate_ms ? this.late_ms_ : 0);
  }

  /** Returns the time since the last message, or null before the first. */
  silence_ms(): number | null {
    return this.heard_at_ms_ === null ? null : this.now_ms_() - this.heard_at_ms_;
  }

  private begin_run(restarted: boolean): void {
    this.forecast = null;
    if (!restarted) return;
    this.trace.clear();
    this.courses.clear();
  }

  private take_frame(frame: StateMessage, silent_ms: number): void {
    // The trace has a gap only if frames were lost on the way. If the page itself was busy, it
    // receives all frames, late.
    if (silent_ms > kSilent_ms && frame.t_s - (this.trace.last_s ?? frame.t_s) > kMissed_s) this.trace.break_off();
    this.t_s = frame.t_s;
    Object.assign(this.q, frame.q);
    this.clearance = frame.clearance;
    this.motions = frame.motions;
    this.trace.push(frame.t_s, frame.q);
    this.put_in_earlier_states();
    // Each motion of a job with steps begins at 0 again, so it has no course.
    this.courses.take(frame.t_s, frame.motions.filter(({ job }) => this.job(job)?.steps === undefined));
    this.pulse_.frame(() => { this.moment_s_ = this.t_s; });
    if (frame.speed === this.speed) return;
    this.speed = frame.speed;
    this.pulse_.change();
  }

  private put_in_earlier_states(): void {
    const states = this.earlier_states_;
    this.earlier_states_ = null;
    if (!states || states.stream !== this.stream) return;
    this.trace.fill(states.joints, states.t_s, states.q);
    this.pulse_.change();
  }
}
