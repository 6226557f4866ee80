// The store as components see it: a component that reads it is drawn again when the store changes.
// No component subscribes by itself, because a forgotten subscription would go unnoticed. (A
// component that reads any signal is not drawn together with its parent if its properties are
// unchanged.) Received events enter the store only here, in the same task as the redraw. So all
// views of a frame show the same state, however late a busy page draws.

import { signal, type Signal } from '@preact/signals';
import { Redraw } from './redraw';
import type { Store } from './store';

const drawings = new WeakMap<Store, Signal<number>>();

/** Returns the same store, and notes that the calling component has read it. */
export function seen(store: Store): Store {
  void drawings_of(store).value;
  return store;
}

/**
 * Redraws the calling component also a few times per second while poses arrive. Clocks and progress
 * bars need this.
 */
export function use_beats(store: Store): void {
  void store.beats.value;
}

function drawings_of(store: Store): Signal<number> {
  const known = drawings.get(store);
  if (known) return known;
  const drawn = signal(0);
  drawings.set(store, drawn);
  const timers = { set: (callback: () => void, delay_ms: number) => Number(setTimeout(callback, delay_ms)), clear: (id: number) => clearTimeout(id) };
  const redraw = new Redraw(() => {
    store.collect();
    drawn.value += 1;
  }, timers, () => performance.now());
  store.on_change(() => redraw.ask());
  store.on_arrival(() => redraw.ask());
  return drawn;
}
