// The lanes of what the page knows. What has ended is gone through when a job ends or an earlier time is
// looked at, not with each picture: with ten thousand jobs in view that would take most of the page's time.

import type { App } from '../state/app';
import type { Store } from '../state/store';
import { lanes_of, pasts_of, type Lane, type Past } from './lanes';

// A motion that ended before what is shown tells since when its arm could have gone on.
const kBefore_s = 60;

interface Kept { of: readonly unknown[]; from_s: number; pasts: ReadonlyMap<string, Past> }

const kept = new WeakMap<Store, Kept>();

/** Of what moves or waits at a time or later, and it may be of some before. */
export function known_lanes({ store }: Pick<App, 'store'>, from_s = store.t_s): Lane[] {
  const { book } = store;
  const pauses = (id: string) => book.pauses(id);
  return lanes_of({
    arms: [...store.arms.keys()], jobs: book.open, pasts: pasts_since(store, from_s - kBefore_s), pauses, has_ended: (id) => book.has_ended(id),
    forecast: store.forecast, now_s: store.t_s,
  });
}

function pasts_since(store: Store, from_s: number): ReadonlyMap<string, Past> {
  const { book, arms } = store;
  const of = [arms, book.endings];
  const known = kept.get(store);
  if (known && known.from_s <= from_s && known.of.every((one, i) => one === of[i])) return known.pasts;
  const pasts = pasts_of([...arms.keys()], book.ended_since(from_s), (id) => book.pauses(id));
  kept.set(store, { of, from_s, pasts });
  return pasts;
}
