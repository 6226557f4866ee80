// The motion that a pasted body describes, so that it can be shown before it is sent. Pure. Only what is
// needed to show it is read; what is wrong with it the server tells.

import type { Bag } from './bag';

export interface Motion {
  duration_s: number;
  /** Every joint of it at a time, in rad or m; joints whose motion has not begun stand at its start. */
  q_at(t_s: number): Record<string, number>;
}

interface Point { t_s: number; q: number[]; v: number[] | null }
interface Piece { names: string[]; points: Point[]; begins_s: number; ends_s: number }

/** Jobs of one arm follow each other; null where there is nothing that could be shown. */
export function motion_of(bag: Bag): Motion | null {
  const bodies = bag.kind === 'bag' ? bag.jobs : [json_of(bag.text)];
  const ends_s = new Map<string, number>();
  const pieces: Piece[] = [];
  for (const body of bodies) {
    const read = read_body(body);
    const last_s = read?.points.at(-1)?.t_s;
    if (!read || last_s === undefined) continue;
    const begins_s = Math.max(0, ...read.names.map((name) => ends_s.get(name) ?? 0));
    for (const name of read.names) ends_s.set(name, begins_s + last_s);
    pieces.push({ ...read, begins_s, ends_s: begins_s + last_s });
  }
  if (pieces.length === 0) return null;
  return { duration_s: Math.max(...pieces.map((piece) => piece.ends_s)), q_at: (t_s) => q_of(pieces, t_s) };
}

function q_of(pieces: readonly Piece[], t_s: number): Record<string, number> {
  const q: Record<string, number> = {};
  for (const piece of pieces) {
    if (t_s < piece.begins_s && piece.names.some((name) => name in q)) continue;
    const values = position(piece.points, t_s - piece.begins_s);
    piece.names.forEach((name, i) => { q[name] = values[i] ?? 0; });
  }
  return q;
}

/** Cubic between points that have velocities, else straight. */
function position(points: readonly Point[], t_s: number): number[] {
  const next = points.findIndex((point) => point.t_s > t_s);
  const after = points[next === -1 ? points.length - 1 : next];
  const before = points[next - 1];
  if (!after) return [];
  if (next === -1 || !before) return after.q;
  const h_s = after.t_s - before.t_s;
  const u = (t_s - before.t_s) / h_s;
  return after.q.map((to, i) => {
    const from = before.q[i] ?? to;
    const [v0, v1] = [before.v?.[i], after.v?.[i]];
    if (v0 === undefined || v1 === undefined) return from + u * (to - from);
    const [a, b] = [1 + 2 * u, 3 - 2 * u];
    return (1 - u) ** 2 * (a * from + u * h_s * v0) + u ** 2 * (b * to + (u - 1) * h_s * v1);
  });
}

function json_of(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}

function read_body(body: unknown): { names: string[]; points: Point[] } | null {
  const outer = child(body, 'trajectory') ?? body;
  const trajectory = child(outer, 'joint_trajectory') ?? outer;
  const names = child(trajectory, 'joint_names');
  const points = child(trajectory, 'points');
  if (!is_list(names) || !names.every((name): name is string => typeof name === 'string') || !is_list(points)) return null;
  const read: Point[] = [];
  for (const point of points) {
    const t_s = seconds_of(child(point, 'time_from_start'));
    const q = numbers_of(child(point, 'positions'));
    if (t_s === null || q?.length !== names.length || t_s < (read.at(-1)?.t_s ?? 0)) return null;
    read.push({ t_s, q, v: numbers_of(child(point, 'velocities')) });
  }
  return read.length === 0 ? null : { names, points: read };
}

function child(value: unknown, key: string): unknown {
  return typeof value === 'object' && value !== null ? (value as Record<string, unknown>)[key] : undefined;
}
const is_list = (value: unknown): value is unknown[] => Array.isArray(value);

function numbers_of(value: unknown): number[] | null {
  return is_list(value) && value.every((one): one is number => typeof one === 'number') ? value : null;
}

function seconds_of(value: unknown): number | null {
  if (typeof value === 'number') return value;
  const sec = child(value, 'sec') ?? child(value, 'secs');
  const nanosec = child(value, 'nanosec') ?? child(value, 'nsecs') ?? 0;
  return typeof sec === 'number' && typeof nanosec === 'number' ? sec + nanosec * 1e-9 : null;
}
