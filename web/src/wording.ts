// What the page says about jobs, in words. Pure functions from the contract's data to sentences.

import type { Job, JobState, MonitorData, WaitsOn } from './messages';

/** An id short enough for a list: a long machine-made one is cut, a name that a client chose stays. */
export function short_id(id: string): string {
  if (/^[0-9a-f]{8}-[0-9a-f]{4}-/i.test(id)) return id.slice(0, 8);
  return id.length > 24 ? `${id.slice(0, 22)}…` : id;
}

export function millimetres(m: number): string {
  const mm = m * 1000;
  if (Math.abs(mm) < 9.95) return `${mm.toFixed(1)} mm`;
  return mm < 1000 ? `${mm.toFixed(0)} mm` : `${m.toFixed(2)} m`;
}

export function seconds(s: number): string {
  if (s < 60) return `${s.toFixed(s < 10 ? 2 : 1)} s`;
  const minutes = Math.floor(s / 60);
  return `${minutes} min ${Math.floor(s - 60 * minutes)} s`;
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
    case 'arm': return how ? `waits for ${who} to move away: ${how}` : `waits for ${who} to move away`;
    case 'object': return how ? `waits for ${who} to be clear: ${how}` : `waits for ${who} to be clear`;
    case 'order': return w.id ? `waits its turn: ${short_id(w.id)}${w.arm ? ` of ${w.arm}` : ''} comes first` : `waits its turn${w.arm ? ` on ${w.arm}` : ''}`;
    case 'capacity': return w.id ? `waits until ${who} has ended: one at a time` : 'waits for a free place';
    case 'stop': return `waits for resume: ${w.arm ?? 'the cell'} is stopped${w.detail ? ` (${w.detail})` : ''}`;
  }
}

function subject(w: WaitsOn): string {
  if (w.kind === 'arm') return w.arm ? `arm ${w.arm}` : 'an arm at rest';
  if (w.kind === 'object') return w.id ?? w.links?.[1] ?? 'an object';
  const owner = w.arm ? ` of ${w.arm}` : '';
  return w.id ? `job ${short_id(w.id)}${owner}` : `another job${owner}`;
}

function approach(w: WaitsOn): string {
  if (!w.links) return '';
  const [own, other] = w.links;
  const when = w.own_time_s === null ? '' : ` at ${w.own_time_s.toFixed(2)} s`;
  if (w.clearance_m === null || w.clearance_m <= 0) return `${own} would touch ${other}${when}`;
  return `${own} would come within ${millimetres(w.clearance_m)} of ${other}${when}`;
}

export function state_in_words(state: JobState): string {
  return state === 'canceled' ? 'cancelled' : state;
}

const kSaidByState: ReadonlySet<string> = new Set(['completed', 'succeeded', 'canceled', 'canceled_by_client']);

/** How a job ended: the reason of the closed list as words, with the server's detail. */
export function result_in_words(job: Job): string {
  if (!job.result) return '';
  // What the state says by itself is not said again.
  const said = kSaidByState.has(job.result.reason) ? '' : job.result.reason.replaceAll('_', ' ');
  return [said, job.result.detail ?? ''].filter((part) => part !== '').join(': ');
}

export function monitor_in_words(event: MonitorData): string {
  const [a, b] = event.links ?? [event.arms[0] ?? 'an arm', event.arms[1] ?? 'the scene'];
  const limit = event.limit_m === null ? '' : ` (limit ${millimetres(event.limit_m)})`;
  const near = event.clearance_m === null ? '' : ` ${millimetres(event.clearance_m)} apart`;
  const stopped = event.stopped.length ? `; stopped ${event.stopped.join(' and ')}` : '';
  switch (event.kind) {
    case 'contact': return `${a} touches ${b}${stopped}`;
    case 'clearance': return `${a} and ${b}${near}${limit}${stopped}`;
    case 'deviation': return `${event.arms.join(' and ')} left the commanded path${stopped}`;
    default: return `${event.kind.replaceAll('_', ' ')}: ${event.arms.join(' and ')}${near}${limit}${stopped}`;
  }
}
