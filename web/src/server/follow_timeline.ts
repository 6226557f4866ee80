// Polls the predicted timeline while the page is visible.

import type { Api } from './api';
import type { Timers } from './connection';
import type { Store } from '../state/store';

const kPeriod_ms = 700;

/**
 * Passes each answer to the store, until the returned function is called. Passes null if the server
 * does not answer or the connection is lost.
 */
export function follow_timeline(
  api: Pick<Api, 'timeline'>, store: Store, timers: Timers, is_visible: () => boolean,
): () => void {
  let closed = false;
  let timer: number | null = null;
  const ask = async () => {
    timer = null;
    if (is_visible()) {
      const answer = store.link.status === 'open' ? await api.timeline() : null;
      if (closed) return;
      store.set_forecast(answer?.ok ? answer.value : null);
    }
    timer = timers.set(() => void ask(), kPeriod_ms);
  };
  void ask();
  return () => {
    closed = true;
    if (timer !== null) timers.clear(timer);
  };
}
