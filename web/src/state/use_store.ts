// Draws a component again when the store changes, and, if asked, some times a second while poses
// come in (for clocks and progress bars). Changes that come in a burst are drawn once; by a timer, as a
// browser that is busy with the 3D view gives out few animation frames.

import { signal, type Signal } from '@preact/signals';
import type { Store } from './store';

const kBurst_ms = 30;

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
  let timer: number | null = null;
  store.on_change(() => {
    timer ??= window.setTimeout(() => {
      timer = null;
      drawn.value += 1;
    }, kBurst_ms);
  });
  return drawn;
}
