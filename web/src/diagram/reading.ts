// Reads a coordination diagram at the current progress of two jobs. Pure. Times are seconds of each
// job's trajectory. Job A runs across, B up.

import { pair_of, type CellState, type Diagram, type DiagramLayer, type DiagramContact, type Job, type WaitsOn } from '../server/messages';
import { progress_at, type Course } from '../state/progress_book';
import { clock, millimeters, short_id } from '../wording';
import { kText } from '../strings';
import type { Ahead } from './ahead';

const kWords = kText.diagram;

export interface Point { a_s: number; b_s: number }

/**
 * Returns the predicted progress from `now`. Both jobs advance equally (45 degrees). The job that
 * ends first then rests at its goal, along the border, until the other job ends.
 */
export function plan_from(now: Point, diagram: Diagram): Point[] {
  const { a, b } = diagram;
  const together_s = Math.max(0, Math.min(a.duration_s - now.a_s, b.duration_s - now.b_s));
  const first_end = { a_s: now.a_s + together_s, b_s: now.b_s + together_s };
  return [now, first_end, { a_s: a.duration_s, b_s: b.duration_s }];
}

/**
 * Returns the measured progress of both jobs up to a time. Empty if the page has not observed one
 * of the jobs.
 */
export function measured_path(a: Course | null, b: Course | null, until_s = Infinity): Point[] {
  if (!a || !b) return [];
  const times_s = [...new Set([...a.t_s, ...b.t_s])].filter((t_s) => t_s <= until_s).sort((x, y) => x - y);
  const path: Point[] = [];
  for (const t_s of times_s) {
    const [a_s, b_s] = [progress_at(a, t_s), progress_at(b, t_s)];
    const last = path.at(-1);
    if (a_s !== null && b_s !== null && (last?.a_s !== a_s || last.b_s !== b_s)) path.push({ a_s, b_s });
  }
  return path;
}

/** Returns the share of the diagram's area in each state. The shares add up to one. */
export function shares(layer: DiagramLayer): Record<CellState, number> {
  const area: Record<CellState, number> = { free: 0, conflict: 0, undecided: 0 };
  for (const { state, a_s, b_s } of layer.cells ?? []) area[state] += (a_s[1] - a_s[0]) * (b_s[1] - b_s[0]);
  const whole = area.free + area.conflict + area.undecided || 1;
  return { free: area.free / whole, conflict: area.conflict / whole, undecided: area.undecided / whole };
}

export interface Evidence extends Point { wait: WaitsOn }

/**
 * If one of the jobs waits for the other, returns the times of their conflict, as the server found
 * them. Else returns null.
 */
export function evidence_of(a: Job | null, b: Job | null): Evidence | null {
  if (!a || !b) return null;
  for (const [waiting, other] of [[a, b], [b, a]] as const) {
    const wait = waiting.waits_on.find((w) => w.kind === 'job' && w.id === other.id);
    if (!wait || wait.own_time_s === null || wait.other_time_s === null) continue;
    return waiting === a
      ? { wait, a_s: wait.own_time_s, b_s: wait.other_time_s }
      : { wait, a_s: wait.other_time_s, b_s: wait.own_time_s };
  }
  return null;
}

export function evidence_in_words(evidence: Evidence, diagram: Diagram): string {
  const { links, clearance_m } = evidence.wait;
  const [own, other] = pair_of(links) ?? [kWords.one_arm, kWords.other_arm];
  const how = clearance_m === null || clearance_m <= 0
    ? kWords.touches(own, other)
    : kWords.comes_within(own, other, millimeters(clearance_m));
  const when = [[diagram.a.id, evidence.a_s], [diagram.b.id, evidence.b_s]] as const;
  return `${how}, ${when.map(([id, at_s]) => kWords.time_in(at_s.toFixed(2), short_id(id))).join(kText.server.and)}.`;
}

/**
 * `free`: no conflict is ahead. `calm`: the scheduler handles it, or it may be no conflict.
 * `alarm`: nothing known prevents the conflict.
 */
export interface PlanWords { tone: 'free' | 'calm' | 'alarm'; words: string }

/**
 * Describes the prediction. `waiting` is the job that has not started, or null. `resting` is the
 * job that has ended, or null.
 */
export function plan_in_words(ahead: Ahead, waiting: string | null, resting: string | null = null): PlanWords {
  const begin = waiting !== null ? kWords.if_started(short_id(waiting))
    : resting === null ? kWords.if_both_continue : kWords.while_rests(short_id(resting));
  switch (ahead.kind) {
    case 'free': return { tone: 'free', words: waiting === null && resting !== null ? kWords.other_is_free(begin) : kWords.both_are_free(begin) };
    case 'waits': return { tone: 'calm', words: kWords.one_waits(begin, contact_in_words(ahead.contact)) };
    case 'allowed': return ahead.contact.state === 'conflict'
      ? { tone: 'alarm', words: kWords.nothing_waits(begin, contact_in_words(ahead.contact)) }
      : { tone: 'calm', words: kWords.may_be_free(begin, contact_in_words(ahead.contact)) };
  }
}

function contact_in_words({ state, in_s }: DiagramContact): string {
  const what = state === 'conflict' ? kWords.a_conflict : kWords.an_uncertified_area;
  return in_s < 0.005 ? kWords.at_once(what) : kWords.in_seconds(what, in_s.toFixed(2));
}

export function drawn_in_words({ a, b }: Diagram): string {
  return kWords.of_jobs(short_id(a.id), short_id(b.id));
}

/**
 * Describes the previous diagram, which is shown until the diagram of the `wanted` jobs arrives.
 * `wanted` is null if there is no such diagram.
 */
export function kept_in_words({ a, b }: Diagram, jobs: readonly (Job | null)[], wanted: { a: string; b: string } | null): string {
  const ends_s = jobs.flatMap((job) => job?.ended_s ?? []);
  const until = ends_s.length === 0 ? kWords.earlier : kWords.as_of(clock(Math.min(...ends_s)));
  const next = wanted === null ? '' : kWords.being_drawn(short_id(wanted.a), short_id(wanted.b));
  return `${until}: ${kWords.of_jobs(short_id(a.id), short_id(b.id))}${next}`;
}
