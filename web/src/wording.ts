// Builds the sentences about jobs, arms and the server; their words are in strings.ts. Pure.

import type { Link } from './server/connection';
import type { Facts, Restart } from './state/facts';
import { detail_without_step, step_in_words } from './jobs/steps';
import { is_stopped } from './state/shown_state';
import { pair_of, type Arm, type CellController, type Clearance, type Job, type MonitorData, type WaitsOn } from './server/messages';
import { cut_text, shown_name, shown_text } from './names';
import { kText } from './strings';

const kLongestId = 24;

/**
 * Returns an id that is short enough for a list. A UUID is shown by its beginning. Another id is
 * cut if it is long.
 */
export function short_id(id: string): string {
  if (/^[0-9a-f]{8}-[0-9a-f]{4}-/i.test(id)) return id.slice(0, 8);
  return cut_text(id, kLongestId);
}

/** Returns the job's name, or its id if it has no name. */
export function title_of(job: Pick<Job, 'id' | 'name'>): string {
  return shown_name(job.name) || short_id(job.id);
}

export function millimeters(m: number): string {
  const mm = m * 1000;
  if (Math.abs(mm) < 9.95) return `${mm.toFixed(1)} mm`;
  return mm < 1000 ? `${mm.toFixed(0)} mm` : `${m.toFixed(2)} m`;
}

export function seconds(s: number): string {
  if (s < 59.95) return `${s.toFixed(1)} s`;
  const whole = Math.round(s);
  if (whole < 3600) return `${Math.floor(whole / 60)} min ${whole % 60} s`;
  return `${Math.floor(whole / 3600)} h ${Math.floor(whole / 60) % 60} min`;
}

export function bytes_in_words(bytes: number): string {
  for (const [unit, size] of [['GB', 1e9], ['MB', 1e6], ['kB', 1e3]] as const) {
    if (bytes >= 0.9995 * size) return `${(bytes / size).toFixed(bytes < 9.95 * size ? 1 : 0)} ${unit}`;
  }
  return `${bytes} B`;
}

/** Formats cell time as h:mm:ss.t. */
export function clock(t_s: number): string {
  const tenths = Math.max(0, Math.floor(t_s * 10));
  const pad = (n: number) => String(n).padStart(2, '0');
  const whole = Math.floor(tenths / 10);
  return `${Math.floor(whole / 3600)}:${pad(Math.floor(whole / 60) % 60)}:${pad(whole % 60)}.${tenths % 10}`;
}

/** Returns in one sentence why a job waits. Empty if the job waits for nothing. */
export function reason_in_words(job: Job): string {
  if (job.cycle.length) return kText.wait.deadlock([...job.cycle, ...job.cycle.slice(0, 1)].map(short_id).join(' -> '));
  const [first, ...rest] = job.waits_on;
  if (!first) return job.state === 'backlogged' ? kText.wait.retried : '';
  return wait_in_words(first) + (rest.length ? kText.wait.and_more(rest.length) : '');
}

export function wait_in_words(w: WaitsOn): string {
  const words = kText.wait;
  const who = subject(w);
  const how = conflict_of(w);
  switch (w.kind) {
    case 'job': return how === '' ? words.for_end(who) : words.for_job(who, how);
    case 'arm': return words.for_arm(who, how, w.detail ?? '');
    case 'object': return words.for_object(who, how);
    case 'predecessor':
      if (w.id) return turn_in_words(w, short_id(w.id));
      return w.arm ? words.turn_on(w.arm) : words.turn;
    case 'capacity': return w.id ? words.one_at_a_time(who) : words.free_slot;
    case 'plan': return words.for_path;
    case 'check': return words.checked(Math.round(100 * (w.progress ?? 0)));
    case 'stop': return words.for_resume(w.arm ?? words.the_cell, w.detail ?? '');
    case 'guard': return words.guard(String(w.detail));
    case 'speed': return words.for_speed(w.arm === null ? words.the_cell : shown_name(w.arm));
    case 'io': return words.for_signal(shown_name(w.id ?? ''), shown_text(w.detail ?? ''));
    case 'action': return words.for_action(shown_text(w.detail ?? ''));
    case 'holding': return shown_text(w.detail ?? '');
  }
}

/** Returns which job goes first, and why if the server says so. */
function turn_in_words(w: WaitsOn, id: string): string {
  const words = kText.wait;
  const turn = words.turn_after(id, w.arm ? words.of_arm(shown_name(w.arm)) : '');
  const links = pair_of(w.links);
  if (!links) return w.detail ? `${turn} (${shown_text(w.detail)})` : turn;
  const [own, other] = [shown_name(links[0]), shown_name(links[1])];
  const touches = w.clearance_m === null || w.clearance_m <= 0;
  return `${turn}: ${touches ? words.would_touch(own, other) : words.would_block(own, other, millimeters(w.clearance_m ?? 0))}`;
}

/**
 * Returns until when a job is blocked, if it is blocked by something that no running job ends: "until
 * crate is moved". Empty otherwise.
 */
export function until_in_words({ waits_on: [first] }: Pick<Job, 'waits_on'>): string {
  const words = kText.wait;
  switch (first?.kind) {
    case 'object': return words.until_moved(subject(first));
    case 'arm': return words.until_clear(subject(first));
    case 'stop': return words.until_resumed;
    case 'speed': return words.until_faster;
    default: return '';
  }
}

/** Returns a warning with its explanation if the job starves, else null. */
export function starvation_in_words({ starvation }: Pick<Job, 'starvation'>): Figure | null {
  if (!starvation) return null;
  const { overtaken_by, bound_s } = starvation;
  return { text: kText.wait.starves(overtaken_by), title: kText.wait.starves_title(overtaken_by, number_in_words(bound_s) + ' s') };
}

/** Returns what a checked job would conflict with. */
export function conflict_in_words(w: WaitsOn): string {
  const how = conflict_of(w);
  return how === '' ? kText.wait.against(subject(w)) : kText.wait.against_because(subject(w), how);
}

function subject(w: WaitsOn): string {
  const words = kText.wait;
  const arm = w.arm === null ? null : shown_name(w.arm);
  if (w.kind === 'arm') return arm ? words.arm(arm) : words.resting_arm;
  if (w.kind === 'object') return shown_name(w.id ?? w.links[1] ?? words.an_object);
  const owner = arm ? words.of_arm(arm) : '';
  if (w.id === null) return words.another_job(owner);
  const id = short_id(w.id);
  return `${/^job\b/i.test(id) ? id : words.job(id)}${owner}`;
}

function conflict_of(w: WaitsOn): string {
  const links = pair_of(w.links);
  if (!links) return '';
  const [own, other] = [shown_name(links[0]), shown_name(links[1])];
  // The time counts from the start of the job's own motion, because the job has not started.
  const when = w.own_time_s === null ? '' : kText.wait.time_in_motion(w.own_time_s.toFixed(2));
  if (w.clearance_m === null || w.clearance_m <= 0) return kText.wait.touches(own, other, when);
  return kText.wait.comes_within(own, other, millimeters(w.clearance_m), when);
}

export interface Figure { text: string; title: string }

/**
 * Returns the number that is most relevant at this stage of the job, with its meaning. `ends_s` is
 * the predicted end.
 */
export function figure_in_words(job: Job, now_s: number, progress: number, ends_s: number | null = null): Figure {
  const words = kText.figure;
  if (job.stopping) return { text: words.stopping, title: words.stopping_title };
  if (job.steps !== undefined && job.started_s !== null && !is_stopped(job)) {
    if (job.state === 'running') return { text: kText.steps.runs_for(seconds(now_s - job.started_s)), title: kText.steps.runs_for_title };
    if (job.state === 'paused') return { text: kText.steps.waits, title: kText.steps.waits_title };
  }
  switch (job.state) {
    case 'running': return { text: words.left(seconds(ends_s === null ? (1 - progress) * (job.duration_s ?? 0) : Math.max(0, ends_s - now_s))), title: ends_s === null ? words.left_title : words.left_with_pauses_title };
    case 'paused': return is_stopped(job) ? { text: words.stopped, title: words.stopped_title } : { text: words.paused, title: words.paused_title };
    case 'queued': case 'backlogged': case 'scheduled': return waited(job, now_s);
    default: break;
  }
  if (job.started_s === null) return waited(job, job.ended_s);
  if (job.ended_s === null) return { text: '', title: '' };
  return { text: words.ran(seconds(job.ended_s - job.started_s)), title: words.ran_title };
}

/** Rephrases a figure in the past tense, because the data is old. */
export function as_last_heard(figure: string): string {
  if (figure === '') return '';
  return /^waited|(left|so far)$/.test(figure) ? kText.figure.had(figure) : kText.figure.was(figure);
}

/**
 * Returns the object that the job waits for, if this is the first thing that it waits for. Else
 * returns null.
 */
export function object_of({ waits_on: [first] }: Pick<Job, 'waits_on'>): string | null {
  return first?.kind === 'object' ? first.id ?? first.links[1] ?? null : null;
}

/** Returns what a job waits for, short enough for a label. */
export function waited_for(job: Pick<Job, 'waits_on'>): string {
  const words = kText.wait;
  const [first] = job.waits_on;
  if (!first) return words.short;
  switch (first.kind) {
    case 'job': case 'arm': case 'object': return words.short_for(subject(first));
    case 'stop': return words.short_resume;
    case 'plan': return words.short_plan;
    case 'check': return words.short_check;
    case 'capacity': return words.free_slot;
    case 'predecessor': return first.id === null ? words.turn : words.behind(short_id(first.id));
    case 'guard': return words.short_guard;
    case 'speed': return words.short_speed;
    case 'io': return words.short_for(shown_name(first.id ?? ''));
    case 'holding': return words.short_holding;
    case 'action': return first.detail === undefined ? words.short_action : shown_text(first.detail);
  }
}

/** Returns what an arm does, or what it waits for. */
export function arm_in_words(arm: Arm, facts: Pick<Facts, 'arm_state' | 'waiting_of'>): string {
  const state = facts.arm_state(arm);
  const next = state === 'waiting' ? facts.waiting_of(arm.name) : null;
  return next ? waited_for(next) : state;
}

/** Returns what the state of an arm does not say: its link, the cause of its stop, its drives. */
export function arm_notes({ link, link_detail, stop_cause, drives_on }: Arm): string[] {
  const words = kText.arm;
  const detail = link_detail === null ? '' : shown_text(link_detail);
  const has_link = link === 'up' || link === 'stale';
  return [
    ...(link === 'lost' ? [words.lost(detail)] : []),
    ...(link === 'connecting' ? [words.connecting(detail)] : []),
    ...(has_link && stop_cause !== null ? [words.stop_cause(shown_text(stop_cause))] : []),
    ...(drives_on ? [] : [words.drives_off]),
  ];
}

/**
 * Returns the titles and values of what a controller promises, with what was measured (null if that
 * is not known). `units` are those of the arm's joints.
 */
export function promises_in_words(controller: CellController, units: string, measured: Pick<Arm, 'deviation_rad' | 'deviation_max_rad'> | null): [title: string, value: string][] {
  const words = kText.arm;
  const ms = (s: number) => number_in_words(1000 * s);
  const thousandths = (value: number) => (1000 * value).toFixed(1);
  const most = `${thousandths(controller.tracking_error_rad)} ${units.replace(/\b(rad|m)\b/g, 'm$1')}`;
  return [
    [words.controller_type, words.controller_types[controller.type]],
    [words.tracking_error, measured === null ? words.tracking_error_promised(most) : words.tracking_error_measured(thousandths(measured.deviation_rad), most, thousandths(measured.deviation_max_rad))],
    [words.reaction, words.reaction_promised(ms(controller.reaction_s))],
    [words.feedback, words.feedback_promised(ms(controller.feedback_period_s), ms(controller.feedback_timeout_s))],
  ];
}

function waited(job: Job, until_s: number | null): Figure {
  if (job.submitted_s === null || until_s === null) return { text: '', title: '' };
  return { text: kText.figure.waited(seconds(Math.max(0, until_s - job.submitted_s))), title: kText.figure.waited_title };
}

/** Rounds away the digits that come from binary numbers: 0.30000001192 becomes 0.3. */
export function number_in_words(value: number): string {
  return String(Number(value.toPrecision(kDigits)));
}

const kDigits = 6;
const kLongestValue = 200;

/**
 * Returns the words for the value that was found at a fault. Empty if the server gives no value.
 */
export function found_in_words(value: unknown): string {
  return value === undefined || value === null || value === '' ? '' : kText.compose.found(cut_text(JSON.stringify(value, (_, part: unknown) => (typeof part === 'number' ? Number(number_in_words(part)) : part)), kLongestValue));
}

/** Returns which kinds of bodies the clearance is between: two arms, or an arm and an object. */
export function clearance_in_words(clearance: Clearance): string {
  return clearance.arms.length > 1 ? kText.view.arm_to_arm : kText.view.arm_to_object;
}

/** Returns why requests cannot reach the server now, or null if they can. */
export function why_not_connected(link: Link): string | null {
  switch (link.status) {
    case 'open': return null;
    case 'connecting': return kText.server.not_connected;
    case 'recording': return kText.server.recording_shown;
    case 'past': return kText.server.past_shown;
    case 'lost': return kText.server.connection_lost;
  }
}

const kSaidByState: ReadonlySet<string> = new Set(['completed', 'succeeded', 'canceled', 'canceled_by_client', 'step_failed']);

const kMostNamed = 6;

/**
 * Returns what is unknown after a restart of the server. `since` is the time of the first message
 * of the new session.
 */
export function restart_in_words({ lost }: Pick<Restart, 'lost'>, since: string): string {
  const named = lost.slice(0, kMostNamed).map((job) => title_of(job)).join(', ');
  const names = lost.length > kMostNamed ? kText.server.names_and_more(named, lost.length - kMostNamed) : named;
  return kText.server.restarted(since, lost.length === 0 ? kText.server.all_known : kText.server.unknown_status(lost.length, names));
}

/**
 * Returns how a job ended: the step at which it ended if it has steps, the reason, which is one of a
 * fixed list, and the server's detail.
 */
export function result_in_words(job: Job): string {
  if (!job.result) return '';
  // The state already says how the job ended.
  const words = kSaidByState.has(job.result.reason) ? '' : job.result.reason.replaceAll('_', ' ');
  return [step_in_words(job, true) ?? '', words, shown_text(detail_without_step(job))].filter((part) => part !== '').join(': ');
}

export function monitor_in_words(event: MonitorData): string {
  const stopped = event.stopped.length ? kText.server.stopped(event.stopped.join(kText.server.and)) : '';
  const [a, b] = event.links ?? [];
  if (event.kind === 'contact') return kText.server.touches(String(a), String(b), stopped);
  if (event.kind !== 'clearance') return `${event.text}${stopped}`;
  return kText.server.apart(String(a), String(b), millimeters(event.clearance_m ?? 0), millimeters(event.limit_m ?? 0), stopped);
}

/** Returns a sentence for each choice the server made about the job's path. */
export function path_in_words(job: Job): string[] {
  const words = kText.path;
  const sentences: string[] = [];
  const { choice, detour, replan } = job;
  if (choice) sentences.push(choice.candidates.length > 1 ? words.selected_from(choice.selected, choice.candidates.join(', '), choice.detail) : words.selected(choice.selected, choice.detail));
  if (detour) {
    const evaluated = words.evaluated(detour.candidates_evaluated);
    const gain = detour.time_saved_s === null ? words.shortest_blocked : words.sooner(seconds(detour.time_saved_s));
    sentences.push(detour.selected ? words.detour(evaluated, gain) : words.no_detour(evaluated));
  }
  if (replan) {
    const cause = words.cause[replan.cause];
    if (replan.done > 0) sentences.push(words.replanned(replan.done, cause));
    if (replan.planning) sentences.push(words.replanning);
    else if (replan.refused !== null) sentences.push(words.not_replanned(cause, replan.refused));
  }
  return sentences;
}
