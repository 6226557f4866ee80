// Predicts which contact two jobs meet in their diagram if both continue, and whether their
// authority lets them reach it. A contact is the first cell that is not free. Pure.
//
// An arm's controller never passes its authority. The server extends authority only where both
// motions are certified free. So if one job lacks authority for a contact, that job will wait
// before it.

import type { Diagram, DiagramContact } from '../server/messages';
import type { Point } from './reading';

/**
 * `free`: there is no contact ahead. `allowed`: both jobs have authority to reach and pass the
 * contact. `waits`: at least one job does not.
 */
export type Ahead = { kind: 'free' } | { kind: 'allowed' | 'waits'; contact: DiagramContact };

// Tolerance at the border of a contact. Diagram cells are as fine as 10 ms, and an arm that waits
// at a conflict rests slightly before or behind its border.
const kBorder_s = 0.05;

/**
 * Returns the prediction. `contact` is the server's last answer; null if no contact is ahead.
 * `authority` is null if unknown. Returns null if the jobs have passed the contact meanwhile.
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
