// Builds the timeline of the jobs that the page knows. Ended jobs are processed again only when a
// job ends or an earlier time is shown. With ten thousand ended jobs they would otherwise take most
// of the time of each redraw.

import type { App } from '../state/app';
import type { Store } from '../state/store';
import { lanes_of, pasts_of, type Known, type Lane, type Past } from './lanes';

// Ended jobs are read from this much before the shown range. The end of such a job can determine
// since when its arm waits.
const kBefore_s = 60;

interface Kept { of: readonly unknown[]; from_s: number; pasts: ReadonlyMap<string, Past> }

const kept = new WeakMap<Store, Kept>();

/** Returns the lanes for the times from `from_s` on. They may also contain earlier marks. */
export function known_lanes({ store }: Pick<App, 'store'>, from_s = store.t_s): Lane[] {
  const { book } = store;
  return lanes_of({
    arms: [...store.arms.keys()], jobs: book.open, pasts: pasts_since(store, from_s - kBefore_s), ...history_of(store), has_ended: (id) => book.has_ended(id),
    forecast: store.forecast, now_s: store.t_s,
  });
}

function history_of({ book }: Store): Pick<Known, 'pauses' | 'steps'> {
  return { pauses: (id) => book.pauses(id), steps: (id) => book.steps(id) };
}

function pasts_since(store: Store, from_s: number): ReadonlyMap<string, Past> {
  const { book, arms } = store;
  const of = [arms, book.endings];
  const known = kept.get(store);
  if (known && known.from_s <= from_s && known.of.every((one, i) => one === of[i])) return known.pasts;
  const pasts = pasts_of([...arms.keys()], book.ended_since(from_s), history_of(store));
  kept.set(store, { of, from_s, pasts });
  return pasts;
}
