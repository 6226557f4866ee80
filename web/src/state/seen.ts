// The store as components see it: a component that reads it is drawn again when it changes. This is
// automatic, because a forgotten subscription would go unnoticed: a component that reads another
// signal, and has unchanged properties, is not drawn with its parent.

import { signal, type Signal } from '@preact/signals';
import { Redraw } from './redraw';
import type { Store } from './store';

const drawings = new WeakMap<Store, Signal<number>>();

/** The same store. */
export function seen(store: Store): Store {
  void drawings_of(store).value;
  return store;
}

/**
 * Also redraws the component a few times per second while poses arrive, for clocks and progress
 * bars.
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
  const redraw = new Redraw(() => { drawn.value += 1; }, timers, () => performance.now());
  store.on_change(() => redraw.ask());
  return drawn;
}
