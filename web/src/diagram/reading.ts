// What a coordination diagram says about two jobs from where they are now. Pure: times in seconds of
// each one's own trajectory, A across and B up.

import { pair_of, type CellState, type Diagram, type DiagramLayer, type DiagramContact, type Job, type WaitsOn } from '../server/messages';
import { progress_at, type Course } from '../state/progress_book';
import { clock, millimetres, short_id } from '../wording';
import type { Ahead } from './ahead';

export interface Point { a_s: number; b_s: number }

/**
 * The plan from `now`: both go on second by second (45 degrees), and whoever ends first rests at its
 * goal (along the border) until the other one has ended, too.
 */
export function plan_from(now: Point, diagram: Diagram): Point[] {
  const { a, b } = diagram;
  const together_s = Math.max(0, Math.min(a.duration_s - now.a_s, b.duration_s - now.b_s));
  const first_end = { a_s: now.a_s + together_s, b_s: now.b_s + together_s };
  return [now, first_end, { a_s: a.duration_s, b_s: b.duration_s }];
}

/** Where the two were together until some time, as measured; empty where one of them was not heard. */
export function measured_way(a: Course | null, b: Course | null, until_s = Infinity): Point[] {
  if (!a || !b) return [];
  const times_s = [...new Set([...a.t_s, ...b.t_s])].filter((t_s) => t_s <= until_s).sort((x, y) => x - y);
  const way: Point[] = [];
  for (const t_s of times_s) {
    const [a_s, b_s] = [progress_at(a, t_s), progress_at(b, t_s)];
    const last = way.at(-1);
    if (a_s !== null && b_s !== null && (last?.a_s !== a_s || last.b_s !== b_s)) way.push({ a_s, b_s });
  }
  return way;
}

/** Shares of the rectangle's area, which add up to one. */
export function shares(layer: DiagramLayer): Record<CellState, number> {
  const area: Record<CellState, number> = { free: 0, conflict: 0, undecided: 0 };
  for (const { state, a_s, b_s } of layer.cells ?? []) area[state] += (a_s[1] - a_s[0]) * (b_s[1] - b_s[0]);
  const whole = area.free + area.conflict + area.undecided || 1;
  return { free: area.free / whole, conflict: area.conflict / whole, undecided: area.undecided / whole };
}

export interface Evidence extends Point { wait: WaitsOn }

/** Where in the diagram the server found the two too close, if one of them waits for the other. */
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
  const [own, other] = pair_of(links) ?? ['one arm', 'the other'];
  const how = clearance_m === null || clearance_m <= 0
    ? `${own} would touch ${other}`
    : `${own} would come within ${millimetres(clearance_m)} of ${other}`;
  const when = [[diagram.a.id, evidence.a_s], [diagram.b.id, evidence.b_s]] as const;
  return `${how}, ${when.map(([id, at_s]) => `${at_s.toFixed(2)} s into ${short_id(id)}`).join(' and ')}.`;
}

/** `calm`: it is seen to; `alarm`: nothing is known that keeps it from happening. */
export interface PlanWords { tone: 'free' | 'calm' | 'alarm'; words: string }

/**
 * What lies ahead, as words; `waiting` is the job that has not begun, `resting` the one that has come to its
 * end, if there is such a one.
 */
export function plan_in_words(ahead: Ahead, waiting: string | null, resting: string | null = null): PlanWords {
  const begin = waiting !== null ? `If ${short_id(waiting)} started now`
    : resting === null ? 'If both went on from here' : `While ${short_id(resting)} rests at its end`;
  switch (ahead.kind) {
    case 'free': return { tone: 'free', words: waiting === null && resting !== null ? `${begin}, the way of the other one is free.` : `${begin}, both would reach their ends through free cells only.` };
    case 'held': return { tone: 'calm', words: `${begin}, they would come to ${met_in_words(ahead.met)}. One of them is not allowed that far (authority): it waits before that.` };
    case 'allowed': return ahead.met.state === 'conflict'
      ? { tone: 'alarm', words: `${begin}, they come to ${met_in_words(ahead.met)}. Both are allowed that far: nothing makes one of them wait.` }
      : { tone: 'calm', words: `${begin}, they come to ${met_in_words(ahead.met)}, which need not be in conflict. Both are allowed that far.` };
  }
}

function met_in_words({ state, in_s }: DiagramContact): string {
  const what = state === 'conflict' ? 'a conflict' : 'what is not proven free';
  return in_s < 0.005 ? `${what} at once` : `${what} in ${in_s.toFixed(2)} s`;
}

export function drawn_in_words({ a, b }: Diagram): string {
  return `${short_id(a.id)} and ${short_id(b.id)}.`;
}

/** Of a drawing that stays until the one of the `wanted` jobs is there; null: it cannot be had. */
export function kept_in_words({ a, b }: Diagram, jobs: readonly (Job | null)[], wanted: { a: string; b: string } | null): string {
  const ends_s = jobs.flatMap((job) => job?.ended_s ?? []);
  const until = ends_s.length === 0 ? 'Drawn before' : `As of ${clock(Math.min(...ends_s))}`;
  const next = wanted === null ? '' : ` ${short_id(wanted.a)} and ${short_id(wanted.b)} are being drawn…`;
  return `${until}: ${short_id(a.id)} and ${short_id(b.id)}.${next}`;
}
