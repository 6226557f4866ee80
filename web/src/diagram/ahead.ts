// Predicts what two jobs meet in their diagram if both continue, and whether their authority lets
// them. Pure.
//
// A controller does not pass its authority, and the server extends authority only where both
// motions are certified free. So a contact beyond the authority of one job does not happen as
// scheduled.

import type { Diagram, DiagramContact } from '../server/messages';
import type { Point } from './reading';

/** `allowed`: both jobs have authority to reach and pass the contact. `waits`: one has not. */
export type Ahead = { kind: 'free' } | { kind: 'allowed' | 'waits'; contact: DiagramContact };

// Cells are as fine as 10 ms; an arm that waits at a conflict rests slightly before or behind its
// border.
const kBorder_s = 0.05;

/**
 * `contact` is the server's last answer, or null if there is none ahead. `authority` is null if no
 * authority is known. Returns null if the contact has been passed meanwhile.
 */
export function ahead_of(contact: DiagramContact | null, now: Point, authority: Point | null, { a, b }: Pick<Diagram, 'a' | 'b'>): Ahead | null {
  if (!contact) return { kind: 'free' };
  const left = { a_s: contact.a_s - now.a_s, b_s: contact.b_s - now.b_s };
  if (Math.min(left.a_s, left.b_s) < -kBorder_s) return null;
  const may_a = may_pass(contact.a_s, Math.max(now.a_s, authority?.a_s ?? 0), a.duration_s);
  const may_b = may_pass(contact.b_s, Math.max(now.b_s, authority?.b_s ?? 0), b.duration_s);
  return { kind: may_a && may_b ? 'allowed' : 'waits', contact: { ...contact, in_s: Math.max(0, left.a_s, left.b_s) } };
}

function may_pass(place_s: number, authority_s: number, end_s: number): boolean {
  return Math.min(place_s + kBorder_s, end_s) <= authority_s;
}
