// Draws a component again when the store changes, and, if asked, some times a second while poses
// come in (for clocks and progress bars).

import { useEffect, useReducer } from 'preact/hooks';
import type { Store } from '../store';

const kLive_ms = 160;

export function use_store(store: Store, live: 'live' | 'changes' = 'changes'): void {
  const [, redraw] = useReducer((n: number) => n + 1, 0);
  useEffect(() => store.on_change(() => redraw(null)), [store]);
  useEffect(() => {
    if (live === 'changes') return;
    let last_ms = 0;
    return store.on_frame(() => {
      const now_ms = performance.now();
      if (now_ms - last_ms < kLive_ms) return;
      last_ms = now_ms;
      redraw(null);
    });
  }, [store, live]);
}
