// The motion of a pasted job or batch, for the preview. Pure.

import type { Batch } from '../compose/batch';
import { child, motion_of_piece, read_trajectory, type Motion, type Piece } from './motion';

/** A trajectory that starts `begins_s` after the beginning of the preview. */
export interface Part { piece: Piece; begins_s: number }

/** Returns the trajectories of a batch. Jobs of the same arm follow one another. */
export function parts_of(batch: Batch): Part[] {
  const bodies = batch.kind === 'batch' ? batch.jobs : [json_of(batch.text)];
  const ends_s = new Map<string, number>();
  const parts: Part[] = [];
  for (const body of bodies) {
    const piece = read_trajectory(child(body, 'trajectory'));
    if (!piece) continue;
    const begins_s = Math.max(0, ...piece.names.map((name) => ends_s.get(name) ?? 0));
    for (const name of piece.names) ends_s.set(name, begins_s + (piece.points.at(-1)?.t_s ?? 0));
    parts.push({ piece, begins_s });
  }
  return parts;
}

/**
 * Reduces the trajectories to about `most` points in total. Keeps every n-th point and the last
 * point of each trajectory.
 */
export function thinned(parts: readonly Part[], most: number): Part[] {
  const points = parts.reduce((sum, { piece }) => sum + piece.points.length, 0);
  const every = Math.ceil(points / most);
  return parts.map(({ piece, begins_s }) => ({
    begins_s, piece: { ...piece, points: piece.points.filter((_, i) => i % every === 0 || i === piece.points.length - 1) },
  }));
}

/** Combines the trajectories into one motion. Returns null if there are none. */
export function motion_of_parts(parts: readonly Part[]): Motion | null {
  if (parts.length === 0) return null;
  const motions = parts.map(({ piece, begins_s }) => ({ motion: motion_of_piece(piece), begins_s }));
  const names = new Set(parts.flatMap(({ piece }) => piece.names));
  const duration_s = Math.max(...motions.map(({ motion, begins_s }) => begins_s + motion.duration_s));
  return { duration_s, names: [...names], q_at: (t_s) => q_of(motions, t_s) };
}

export function motion_of(batch: Batch): Motion | null {
  return motion_of_parts(parts_of(batch));
}

function q_of(motions: readonly { motion: Motion; begins_s: number }[], t_s: number): Record<string, number> {
  const q: Record<string, number> = {};
  for (const { motion, begins_s } of motions) {
    if (t_s < begins_s && motion.names.some((name) => name in q)) continue;
    Object.assign(q, motion.q_at(t_s - begins_s));
  }
  return q;
}

function json_of(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}
