// Resolves the time in the page's address. Pure. A time without data has no pose. The pose of
// another time is never shown instead.

import type { Address } from '../route/address';
import { clock } from '../wording';
import { kText } from '../strings';
import type { Store } from './store';
import type { Heard } from './trace';

export type Unheard = Exclude<Heard, 'kept'> | 'other-run';
export type Instant = { kind: 'now' } | { kind: 'kept'; t_s: number } | { kind: 'unheard'; t_s: number; why: Unheard };

type Known = Pick<Store, 'trace' | 'stream'>;

export function instant_of({ t_s, run }: Pick<Address, 't_s' | 'run'>, store: Known): Instant {
  if (t_s === null) return { kind: 'now' };
  if (!is_of_this_run(run, store)) return { kind: 'unheard', t_s, why: 'other-run' };
  const heard = store.trace.heard(t_s);
  return heard === 'kept' ? { kind: 'kept', t_s } : { kind: 'unheard', t_s, why: heard };
}

/**
 * Returns true if the time is of the present server session. Cell time starts again with each
 * session.
 */
export function is_of_this_run(run: string | null, { stream }: Pick<Store, 'stream'>): boolean {
  return run === null || stream === null || stream.startsWith(run);
}

/** Returns the positions of all joints at the time, or null if they are unknown. */
export function pose_at(instant: Instant, { q, trace }: Pick<Store, 'q' | 'trace'>): Readonly<Record<string, number>> | null {
  switch (instant.kind) {
    case 'now': return Object.keys(q).length === 0 ? null : q;  // the page has received no data yet
    case 'kept': return trace.at(instant.t_s);
    case 'unheard': return null;
  }
}

export function why_unheard(why: Unheard, { trace, t_s }: Pick<Store, 'trace' | 't_s'>): string {
  const [first_s, last_s] = [trace.first_s ?? t_s, trace.last_s ?? t_s];
  const words = kText.server.positions;
  switch (why) {
    case 'nothing': return words.no_data;
    case 'before': return words.before(clock(first_s));
    case 'after': return words.after(clock(last_s));
    case 'gap': return words.gap;
    case 'other-run': return words['other-run'];
  }
}
