// Fetches what the arms are expected to do, again and again while the page is looked at.

import type { Api } from './api';
import type { Timers } from './connection';
import type { Store } from '../state/store';

const kPeriod_ms = 700;

/** Tells the store every answer, null where there is none, until the answer is called. */
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
