// Polls one job while its details are shown, because events do not report progress.

import type { Api } from './api';
import type { Timers } from './connection';
import type { Store } from '../state/store';

const kPeriod_ms = 1000;

/** Polls every second until the job has ended or the returned function is called. */
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
      // If the server refuses, the page keeps the job as it knows it from events.
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
