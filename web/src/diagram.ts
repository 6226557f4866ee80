// What a coordination diagram says about two jobs from where they are now. Pure: times in seconds of
// each one's own trajectory, A across and B up.

import { pair_of, type CellState, type Diagram, type DiagramLayer, type Job, type WaitsOn } from './messages';
import { millimetres, short_id } from './wording';

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

export interface Meeting extends Point { state: CellState; in_s: number }

/**
 * What stands in the way: the first conflict, or, where there is none, the first cell that is not
 * decided; and when it is entered, counted from the way's start. (Around each conflict lies a seam
 * of undecided cells, which says nothing more.)
 */
export function first_met(way: readonly Point[], layer: DiagramLayer): Meeting | null {
  return first_of('conflict', way, layer) ?? first_of('undecided', way, layer);
}

// A diagram has thousands of cells, most of them free, and is looked at again some times a second.
const sorted = new WeakMap<DiagramLayer, Map<CellState, DiagramLayer['cells'][number][]>>();

function cells_in(state: CellState, layer: DiagramLayer): DiagramLayer['cells'][number][] {
  let by_state = sorted.get(layer);
  if (!by_state) {
    by_state = new Map<CellState, DiagramLayer['cells'][number][]>([['free', []], ['conflict', []], ['undecided', []]]);
    for (const cell of layer.cells) by_state.get(cell.state)?.push(cell);
    sorted.set(layer, by_state);
  }
  return by_state.get(state) ?? [];
}

function first_of(state: CellState, way: readonly Point[], layer: DiagramLayer): Meeting | null {
  let passed_s = 0;
  for (let i = 1; i < way.length; i += 1) {
    const from = way[i - 1];
    const to = way[i];
    if (!from || !to) break;
    const length_s = Math.max(to.a_s - from.a_s, to.b_s - from.b_s);
    let met: Meeting | null = null;
    for (const cell of cells_in(state, layer)) {
      const enters = entry(from, to, cell.a_s, cell.b_s);
      if (enters === null || (met && passed_s + enters * length_s >= met.in_s)) continue;
      met = {
        state, in_s: passed_s + enters * length_s,
        a_s: from.a_s + enters * (to.a_s - from.a_s), b_s: from.b_s + enters * (to.b_s - from.b_s),
      };
    }
    if (met) return met;
    passed_s += length_s;
  }
  return null;
}

/** The share (0..1) of a stretch at which it enters a closed rectangle; null when it passes by. */
function entry(from: Point, to: Point, a_s: [number, number], b_s: [number, number]): number | null {
  let enters = 0;
  let leaves = 1;
  for (const [start, end, [low, high]] of [[from.a_s, to.a_s, a_s], [from.b_s, to.b_s, b_s]] as const) {
    const span = end - start;
    if (span <= 0) {
      if (start < low || start > high) return null;
      continue;
    }
    enters = Math.max(enters, (low - start) / span);
    leaves = Math.min(leaves, (high - start) / span);
  }
  // A corner that is only touched is not entered.
  return enters < leaves || from.a_s === to.a_s && from.b_s === to.b_s && enters <= leaves ? enters : null;
}

/** Shares of the rectangle's area, which add up to one. */
export function shares(layer: DiagramLayer): Record<CellState, number> {
  const area: Record<CellState, number> = { free: 0, conflict: 0, undecided: 0 };
  for (const { state, a_s, b_s } of layer.cells) area[state] += (a_s[1] - a_s[0]) * (b_s[1] - b_s[0]);
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

/**
 * What the plan from now meets, one sentence; `waiting` is the job that has not begun, `resting` the
 * one that has come to its end, if there is such a one.
 */
export function plan_in_words(met: Meeting | null, waiting: string | null, resting: string | null = null): string {
  const begin = waiting !== null ? `If ${short_id(waiting)} started now`
    : resting === null ? 'If both go on from here' : `While ${short_id(resting)} rests at its end`;
  if (!met && waiting === null && resting !== null) return `${begin}, the way of the other one is free.`;
  if (!met) return `${begin}, both reach their ends through free cells only.`;
  const what = met.state === 'conflict' ? 'a conflict' : 'what is not proven free';
  return met.in_s < 0.005 ? `${begin}, they are at ${what} at once.` : `${begin}, they meet ${what} in ${met.in_s.toFixed(2)} s.`;
}
