// What the page says about jobs, in words. Pure functions from the contract's data to sentences.

import type { Link } from './server/connection';
import type { Facts, Restart } from './state/facts';
import { is_stopped } from './state/standing';
import { pair_of, type Arm, type Clearance, type Job, type MonitorData, type WaitsOn } from './server/messages';
import { cut_text, shown_name, shown_text } from './names';

const kLongestId = 24;

/** An id short enough for a list: a long machine-made one is cut, a name that a client chose stays. */
export function short_id(id: string): string {
  if (/^[0-9a-f]{8}-[0-9a-f]{4}-/i.test(id)) return id.slice(0, 8);
  return cut_text(id, kLongestId);
}

/** What a job is called: by its name, or else by its id. */
export function title_of(job: Pick<Job, 'id' | 'name'>): string {
  return shown_name(job.name) || short_id(job.id);
}

export function millimetres(m: number): string {
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

/** Cell time as h:mm:ss.t, for the header and the event list. */
export function clock(t_s: number): string {
  const tenths = Math.max(0, Math.floor(t_s * 10));
  const pad = (n: number) => String(n).padStart(2, '0');
  const whole = Math.floor(tenths / 10);
  return `${Math.floor(whole / 3600)}:${pad(Math.floor(whole / 60) % 60)}:${pad(whole % 60)}.${tenths % 10}`;
}

/** Why a job waits, one sentence; empty when it waits on nothing. */
export function reason_in_words(job: Job): string {
  if (job.cycle.length) return `deadlock: ${[...job.cycle, ...job.cycle.slice(0, 1)].map(short_id).join(' -> ')}`;
  const [first, ...rest] = job.waits_on;
  if (!first) return job.state === 'backlogged' ? 'waits to be tried again' : '';
  const more = rest.length ? ` (and ${rest.length} more)` : '';
  return wait_in_words(first) + more;
}

export function wait_in_words(w: WaitsOn): string {
  const who = subject(w);
  const how = approach(w);
  switch (w.kind) {
    case 'job': return how ? `waits for ${who}: ${how}` : `waits for ${who} to end`;
    case 'arm': return `waits for ${who} to move away${how ? `: ${how}` : ''}${w.detail ? ` (${w.detail})` : ''}`;
    case 'object': return how ? `waits for ${who} to be clear: ${how}` : `waits for ${who} to be clear`;
    case 'predecessor': return w.id ? `waits its turn: ${short_id(w.id)}${w.arm ? ` of ${w.arm}` : ''} comes first` : `waits its turn${w.arm ? ` on ${w.arm}` : ''}`;
    case 'capacity': return w.id ? `waits until ${who} has ended: one at a time` : 'waits for a free place';
    case 'plan': return 'waits until the way to its goal is planned';
    case 'check': return `is being checked: ${Math.round(100 * (w.progress ?? 0))} %`;
    case 'stop': return `waits for resume: ${w.arm ?? 'the cell'} is stopped${w.detail ? ` (${w.detail})` : ''}`;
    case 'guard': return `kept back by the ${w.detail}`;
  }
}

/** What a job that was only asked about would meet. */
export function conflict_in_words(w: WaitsOn): string {
  const how = approach(w);
  return how === '' ? `beside ${subject(w)}` : `beside ${subject(w)}, ${how}`;
}

function subject(w: WaitsOn): string {
  const arm = w.arm === null ? null : shown_name(w.arm);
  if (w.kind === 'arm') return arm ? `arm ${arm}` : 'an arm at rest';
  if (w.kind === 'object') return shown_name(w.id ?? w.links[1] ?? 'an object');
  const owner = arm ? ` of ${arm}` : '';
  if (w.id === null) return `another job${owner}`;
  const id = short_id(w.id);
  return `${/^job\b/i.test(id) ? id : `job ${id}`}${owner}`;
}

function approach(w: WaitsOn): string {
  const links = pair_of(w.links);
  if (!links) return '';
  const [own, other] = [shown_name(links[0]), shown_name(links[1])];
  // The job has not begun: the time counts from its own start, whenever that will be.
  const when = w.own_time_s === null ? '' : `, ${w.own_time_s.toFixed(2)} s into its motion`;
  if (w.clearance_m === null || w.clearance_m <= 0) return `${own} would touch ${other}${when}`;
  return `${own} would come within ${millimetres(w.clearance_m)} of ${other}${when}`;
}

export interface Figure { text: string; title: string }

/** The one number that matters at this stage of a job's life, and what it means; `ends_s`: as the server expects it. */
export function figure_in_words(job: Job, now_s: number, progress: number, ends_s: number | null = null): Figure {
  if (job.stopping) return { text: 'stopping', title: 'Brakes on its path' };
  switch (job.state) {
    case 'running': return { text: `${seconds(ends_s === null ? (1 - progress) * (job.duration_s ?? 0) : Math.max(0, ends_s - now_s))} left`, title: ends_s === null ? 'Time until its motion ends' : 'Time until its motion ends, with the pauses that are expected' };
    case 'paused': return is_stopped(job) ? { text: 'stopped', title: 'Stands on its path until its arm is resumed' } : { text: 'paused', title: 'Stands still on its path' };
    case 'queued': case 'backlogged': case 'scheduled': return waited(job, now_s);
    default: break;
  }
  if (job.started_s === null) return waited(job, job.ended_s);
  if (job.ended_s === null) return { text: '', title: '' };
  return { text: `ran ${seconds(job.ended_s - job.started_s)}`, title: 'From its start to its end' };
}

/** The same of a job that nothing has been heard of for a while. */
export function as_last_heard(figure: string): string {
  if (figure === '') return '';
  return /^waited|left$/.test(figure) ? `had ${figure}` : `was ${figure}`;
}

/** The object that a job waits for before all else. */
export function object_of({ waits_on: [first] }: Pick<Job, 'waits_on'>): string | null {
  return first?.kind === 'object' ? first.id ?? first.links[1] ?? null : null;
}

/** For whom or what a job waits, short enough for a label. */
export function waited_for(job: Pick<Job, 'waits_on'>): string {
  const [first] = job.waits_on;
  if (!first) return 'waiting';
  switch (first.kind) {
    case 'job': case 'arm': case 'object': return `waits for ${subject(first)}`;
    case 'stop': return 'waits for resume';
    case 'plan': return 'waits for its plan';
    case 'check': return 'is being checked';
    case 'capacity': return 'waits for a free place';
    case 'predecessor': return 'waits its turn';
    case 'guard': return 'kept back by the authority guard';
  }
}

/** What an arm does, or for what it waits. */
export function arm_in_words(arm: Arm, facts: Pick<Facts, 'arm_state' | 'waiting_of'>): string {
  const state = facts.arm_state(arm);
  const next = state === 'waiting' ? facts.waiting_of(arm.name) : null;
  return next ? waited_for(next) : state;
}

function waited(job: Job, until_s: number | null): Figure {
  if (job.submitted_s === null || until_s === null) return { text: '', title: '' };
  return { text: `waited ${seconds(Math.max(0, until_s - job.submitted_s))}`, title: 'Since it was submitted, without having started' };
}

/** Without the digits that only tell how a computer keeps it: 0.30000001192 is 0.3. */
export function number_in_words(value: number): string {
  return String(Number(value.toPrecision(kDigits)));
}

const kDigits = 6;
const kLongestValue = 200;

/** What a refused request held at the place of the fault; empty when the server does not say. */
export function found_in_words(value: unknown): string {
  return value === undefined || value === null || value === '' ? '' : `found ${cut_text(JSON.stringify(value, (_, part: unknown) => (typeof part === 'number' ? Number(number_in_words(part)) : part)), kLongestValue)}`;
}

/** Between what a clearance was measured. */
export function clearance_in_words(clearance: Clearance): string {
  return clearance.arms.length > 1 ? 'arm to arm' : 'arm to object';
}

/** Why nothing can be asked of the server now; null when it can. */
export function why_mute(link: Link): string | null {
  switch (link.status) {
    case 'open': return null;
    case 'connecting': return 'Not connected to the server yet';
    case 'recording': return 'A recording is shown, not the present';
    case 'past': return 'This is how it was, not how it is now';
    case 'lost': return 'The connection to the server is lost';
  }
}

const kSaidByState: ReadonlySet<string> = new Set(['completed', 'succeeded', 'canceled', 'canceled_by_client']);

const kMostNamed = 6;

/** What is not known any more after a restart; `since`: when it was heard of. */
export function restart_in_words({ lost }: Pick<Restart, 'lost'>, since: string): string {
  const named = lost.slice(0, kMostNamed).map((job) => title_of(job)).join(', ');
  const more = lost.length > kMostNamed ? ` and ${lost.length - kMostNamed} more` : '';
  const jobs = lost.length === 0 ? 'No job was under way that it does not tell of.' : `What became of ${lost.length === 1 ? 'a job' : `${lost.length} jobs`} it does not tell: ${named}${more}; the history has them, if it is kept.`;
  return `The server was restarted; it answers again since ${since}. ${jobs} Where the arms were before is not shown any more.`;
}

/** How a job ended: the reason of the closed list as words, with the server's detail. */
export function result_in_words(job: Job): string {
  if (!job.result) return '';
  // What the state says by itself is not said again.
  const said = kSaidByState.has(job.result.reason) ? '' : job.result.reason.replaceAll('_', ' ');
  return [said, shown_text(job.result.detail)].filter((part) => part !== '').join(': ');
}

export function monitor_in_words(event: MonitorData): string {
  const [a, b] = event.links;
  const stopped = event.stopped.length ? `; stopped ${event.stopped.join(' and ')}` : '';
  if (event.kind === 'contact') return `${a} touches ${b}${stopped}`;
  return `${a} and ${b} ${millimetres(event.clearance_m)} apart (limit ${millimetres(event.limit_m)})${stopped}`;
}

/** How its way came to be another one than its client's, or it came to be taken: a sentence each. */
export function ways_in_words(job: Job): string[] {
  const said: string[] = [];
  const { choice, detour, replan } = job;
  if (choice) said.push(choice.candidates.length > 1 ? `${choice.selected} was taken of ${choice.candidates.join(', ')}: ${choice.detail}` : `${choice.selected} was taken: ${choice.detail}`);
  if (detour) {
    const ways = detour.candidates_evaluated === 1 ? 'one way around what others hold was weighed' : `${detour.candidates_evaluated} ways around what others hold were weighed`;
    const gain = detour.time_saved_s === null ? 'the shortest one could not go' : `by this one it arrives ${seconds(detour.time_saved_s)} sooner`;
    said.push(detour.selected ? `goes around: ${ways}, ${gain}` : `${ways}; the shortest one is as good`);
  }
  if (replan) {
    const why = { client: 'as a client asked', timeout: 'when its time in the backlog was over', blocked: 'past what rested in its way' }[replan.cause];
    if (replan.done > 0) said.push(`was given another way ${replan.done === 1 ? 'once' : `${replan.done} times`}, the last time ${why}`);
    if (replan.planning) said.push('another way is being looked for');
    else if (replan.refused !== null) said.push(`another way was looked for ${why}, in vain: ${replan.refused}`);
  }
  return said;
}
