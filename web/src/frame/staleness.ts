// Detects old data: the server has been silent for a while, or its data arrives late.

import { signal, type ReadonlySignal } from '@preact/signals';
import type { Store } from '../state/store';

const kFresh_ms = 2_500;
const kLook_ms = 500;

const known = new WeakMap<Store, ReadonlySignal<number | null>>();

/** Returns the age of the data in seconds, or null if it is fresh. */
export function use_staleness(store: Store): number | null {
  let stale_s = known.get(store);
  if (!stale_s) {
    stale_s = watch(store);
    known.set(store, stale_s);
  }
  return stale_s.value;
}

/** Returns true if the server is silent, false if its data is late. */
export function is_silent(store: Store): boolean {
  return (store.silence_ms() ?? 0) >= kFresh_ms;
}

/** Returns true if the data is old or the connection lost, so that the present state is unknown. */
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
