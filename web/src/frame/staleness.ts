// Whether what the page shows is old: nothing was heard for a while, be the connection open or not, or what is
// heard comes late.

import { signal, type ReadonlySignal } from '@preact/signals';
import type { Store } from '../state/store';

const kFresh_ms = 2_500;
const kLook_ms = 500;

const known = new WeakMap<Store, ReadonlySignal<number | null>>();

/** How many seconds old what is known is; null while that is not long. */
export function use_staleness(store: Store): number | null {
  let stale_s = known.get(store);
  if (!stale_s) {
    stale_s = watch(store);
    known.set(store, stale_s);
  }
  return stale_s.value;
}

/** Whether nothing was heard, rather than late. */
export function is_silent(store: Store): boolean {
  return (store.silence_ms() ?? 0) >= kFresh_ms;
}

/** Whether what is shown is of some time ago, and nobody knows what is now. */
export function use_stale(store: Store): boolean {
  return use_staleness(store) !== null || store.link.status === 'lost';
}

function watch(store: Store): ReadonlySignal<number | null> {
  const stale_s = signal<number | null>(null);
  window.setInterval(() => {
    const age_ms = store.age_ms();
    stale_s.value = age_ms === null || age_ms < kFresh_ms ? null : Math.floor(age_ms / 1000);
  }, kLook_ms);
  return stale_s;
}
