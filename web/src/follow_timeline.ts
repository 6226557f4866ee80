// Fetches what the arms are expected to do, a second after each answer while the page is looked at.

import type { Api } from './api';
import type { Timers } from './connection';
import type { Forecast } from './messages';
import type { Store } from './store';

const kPeriod_ms = 1000;

/** Tells `take` every answer, null where there is none, until the answer is called. */
export function follow_timeline(
  api: Pick<Api, 'timeline'>, store: Store, timers: Timers, is_visible: () => boolean,
  take: (forecast: Forecast | null) => void,
): () => void {
  let closed = false;
  let timer: number | null = null;
  const ask = async () => {
    timer = null;
    if (is_visible()) {
      const answer = store.link.status === 'lost' ? null : await api.timeline();
      if (closed) return;
      take(answer?.ok ? answer.value : null);
    }
    timer = timers.set(() => void ask(), kPeriod_ms);
  };
  void ask();
  return () => {
    closed = true;
    if (timer !== null) timers.clear(timer);
  };
}
