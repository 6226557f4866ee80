// The motion that a pasted body, or a bag of them, describes, so that it can be shown before it is sent.
// Pure.

import type { Bag } from '../compose/bag';
import { child, motion_of_piece, read_trajectory, type Motion } from './motion';

interface Part { motion: Motion; begins_s: number }

/** Jobs of one arm follow each other; null where there is nothing that could be shown. */
export function motion_of(bag: Bag): Motion | null {
  const bodies = bag.kind === 'bag' ? bag.jobs : [json_of(bag.text)];
  const ends_s = new Map<string, number>();
  const parts: Part[] = [];
  for (const body of bodies) {
    const piece = read_trajectory(child(body, 'trajectory'));
    if (!piece) continue;
    const motion = motion_of_piece(piece);
    const begins_s = Math.max(0, ...piece.names.map((name) => ends_s.get(name) ?? 0));
    for (const name of piece.names) ends_s.set(name, begins_s + motion.duration_s);
    parts.push({ motion, begins_s });
  }
  if (parts.length === 0) return null;
  return { duration_s: Math.max(...ends_s.values()), names: [...ends_s.keys()], q_at: (t_s) => q_of(parts, t_s) };
}

function q_of(parts: readonly Part[], t_s: number): Record<string, number> {
  const q: Record<string, number> = {};
  for (const { motion, begins_s } of parts) {
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
