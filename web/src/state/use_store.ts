// Draws a component again when the store changes, and, if asked, some times a second while poses
// come in (for clocks and progress bars).

import { signal, type Signal } from '@preact/signals';
import { Redraw } from './redraw';
import type { Store } from './store';

const drawings = new WeakMap<Store, Signal<number>>();

export function use_store(store: Store, live: 'live' | 'changes' = 'changes'): void {
  void drawings_of(store).value;
  if (live === 'live') void store.beats.value;
}

function drawings_of(store: Store): Signal<number> {
  const known = drawings.get(store);
  if (known) return known;
  const drawn = signal(0);
  drawings.set(store, drawn);
  const timers = { set: (callback: () => void, delay_ms: number) => window.setTimeout(callback, delay_ms), clear: (id: number) => window.clearTimeout(id) };
  const redraw = new Redraw(() => { drawn.value += 1; }, timers, () => performance.now());
  store.on_change(() => redraw.ask());
  return drawn;
}
