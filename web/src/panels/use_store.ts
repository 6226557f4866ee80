// Draws a component again when the store changes, and, if asked, some times a second while poses
// come in (for clocks and progress bars).

import type { Store } from '../store';

export function use_store(store: Store, live: 'live' | 'changes' = 'changes'): void {
  void store.changes.value;
  if (live === 'live') void store.beats.value;
}
