// Fetches one job again and again while its details are shown: events come when its state changes,
// its progress is only known to who asks.

import type { Api } from './api';
import type { Timers } from './connection';
import type { Store } from '../state/store';

const kPeriod_ms = 1000;

/** Asks at once, then a second after each answer, until the job has ended or the answer is called. */
export function follow_job(id: string, api: Pick<Api, 'job'>, store: Store, timers: Timers): () => void {
  let closed = false;
  let timer: number | null = null;
  const ask = async () => {
    timer = null;
    const job = store.job(id);
    if (!job || store.is_terminal(job)) return;
    if (store.link.status !== 'lost') {
      const answer = await api.job(id);
      if (closed) return;
      // A refusal needs no words here: what events say about the job is shown all the same.
      if (answer.ok) store.refresh_job(answer.value);
    }
    timer = timers.set(() => void ask(), kPeriod_ms);
  };
  void ask();
  return () => {
    closed = true;
    if (timer !== null) timers.clear(timer);
  };
}
