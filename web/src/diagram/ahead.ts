// What lies ahead of two jobs in their diagram if both go on from where they are, as the server says it, and
// whether they may. Pure.
//
// Authority is how far a controller goes by itself; beyond it the server lets an arm go only where what both may
// then do is certified free. So what lies beyond the authority of one of them is not going to happen as things are.

import type { Diagram, DiagramContact } from '../server/messages';
import type { Point } from './reading';

/** `allowed`: both may go until there and on. `waits`: one of them may not. */
export type Ahead = { kind: 'free' } | { kind: 'allowed' | 'waits'; contact: DiagramContact };

// Cells are as fine as 10 ms; who waits at the border of a conflict stands a little before or behind it.
const kBorder_s = 0.05;

/** `contact`: as the server answered some time ago; null: nothing. `authority`: null: none was told of. The answer is null where what was contact lies behind by now. */
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
