// Detects old data: the server has sent nothing for 2.5 s, or its data arrives late.

import { signal, type ReadonlySignal } from '@preact/signals';
import type { Store } from '../state/store';

const kFresh_ms = 2_500;
const kLook_ms = 500;

const known = new WeakMap<Store, ReadonlySignal<number | null>>();

/** Returns the age of the data in whole seconds, or null if the data is fresh. */
export function use_staleness(store: Store): number | null {
  let stale_s = known.get(store);
  if (!stale_s) {
    stale_s = watch(store);
    known.set(store, stale_s);
  }
  return stale_s.value;
}

/**
 * Returns true if the server is silent. If the data is old but this returns false, the data arrives
 * late.
 */
export function is_silent(store: Store): boolean {
  return (store.silence_ms() ?? 0) >= kFresh_ms;
}

/**
 * Returns true if the present state is unknown, because the data is old or the connection is lost.
 */
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
