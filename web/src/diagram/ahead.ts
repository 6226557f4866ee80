// What lies ahead of two jobs in their diagram if both go on from where they are, and whether they may. Pure.
//
// Authority is how far a controller goes by itself; beyond it the server lets an arm go only where what both may
// then do is certified free. So what lies beyond the authority of one of them is not going to happen as things are.

import type { CellState, Diagram, DiagramLayer, DiagramMeeting } from '../server/messages';
import { plan_from, type Point } from './reading';

/** `in_conflict`: they are in one now. `allowed`: both may go until there and on. `held`: one of them may not. */
export type Ahead = { kind: 'free' } | { kind: 'in_conflict' } | { kind: 'allowed' | 'held'; met: DiagramMeeting };

// Cells are as fine as 10 ms; who waits at the border of a conflict stands a little before or behind it.
const kBorder_s = 0.05;

/** `authority`: null: none was told of. */
export function ahead_of(now: Point, authority: Point | null, diagram: Diagram, layer: DiagramLayer): Ahead {
  const deep = [now, { ...now, a_s: now.a_s - kBorder_s }, { ...now, b_s: now.b_s - kBorder_s }];
  if (deep.every((point) => is_in_conflict(layer, point))) return { kind: 'in_conflict' };
  const met = first_met(plan_from(now, diagram), layer);
  if (!met) return { kind: 'free' };
  const { a, b } = diagram;
  const may_a = may_pass(met.a_s, Math.max(now.a_s, authority?.a_s ?? 0), a.duration_s);
  const may_b = may_pass(met.b_s, Math.max(now.b_s, authority?.b_s ?? 0), b.duration_s);
  return { kind: may_a && may_b ? 'allowed' : 'held', met };
}

function may_pass(place_s: number, authority_s: number, end_s: number): boolean {
  return Math.min(place_s + kBorder_s, end_s) <= authority_s;
}

function is_in_conflict({ cells }: DiagramLayer, { a_s, b_s }: Point): boolean {
  return (cells ?? []).some((cell) => cell.state === 'conflict' && cell.a_s[0] <= a_s && a_s <= cell.a_s[1] && cell.b_s[0] <= b_s && b_s <= cell.b_s[1]);
}

/** As the server has it (core/executive/plan_ahead): the first conflict, else the first that is undecided. */
export function first_met(way: readonly Point[], layer: DiagramLayer): DiagramMeeting | null {
  return first_of('conflict', way, layer) ?? first_of('undecided', way, layer);
}

function first_of(state: CellState, way: readonly Point[], { cells }: DiagramLayer): DiagramMeeting | null {
  let passed_s = 0;
  for (const [i, to] of way.entries()) {
    const from = way[i - 1];
    if (!from) continue;
    let first = Infinity;
    for (const cell of cells ?? []) if (cell.state === state) first = Math.min(first, entry(from, to, cell.a_s, cell.b_s));
    const length_s = Math.max(to.a_s - from.a_s, to.b_s - from.b_s);
    if (first < Infinity) {
      return { state, in_s: passed_s + first * length_s, a_s: from.a_s + first * (to.a_s - from.a_s), b_s: from.b_s + first * (to.b_s - from.b_s) };
    }
    passed_s += length_s;
  }
  return null;
}

/** The share of a stretch at which it enters a closed rectangle; Infinity: it passes by. */
function entry(from: Point, to: Point, [a_low, a_high]: readonly [number, number], [b_low, b_high]: readonly [number, number]): number {
  let [enters, leaves] = [0, 1];
  for (const [start, end, low, high] of [[from.a_s, to.a_s, a_low, a_high], [from.b_s, to.b_s, b_low, b_high]] as const) {
    const span = end - start;
    if (span <= 0) {
      if (start < low || start > high) return Infinity;
      continue;
    }
    enters = Math.max(enters, (low - start) / span);
    leaves = Math.min(leaves, (high - start) / span);
  }
  return enters < leaves ? enters : Infinity;
}
