// Banners under the header: lost connection, old data, unreadable cell, refused request.

import { useEffect, useState } from 'preact/hooks';
import type { App } from '../state/app';
import { short_wall_time } from '../wall_time';
import { restart_in_words, seconds } from '../wording';
import { drop_fault, files_over } from './drops';
import { kText } from '../strings';
import { is_silent, use_staleness } from './staleness';

const kWords = kText.frame;

export function Banner({ app }: { app: App }) {
  const { store, actions } = app;
  const refusal = actions.refusal.value;
  const stale_s = use_staleness(store);
  return (
    <div class="banners">
      {files_over.value && (
        <div class="banner" role="status" data-test="files-over"><span>{kWords.drop_here}</span></div>
      )}
      {store.link.status === 'lost' && <Lost app={app} />}
      {store.link.status === 'open' && stale_s !== null && (
        <div class="banner lost" role="alert" data-test="stale">
          <span><b>{kWords.old_data}</b> {is_silent(store) ? kWords.no_data_for(seconds(stale_s)) : kWords.data_late_by(seconds(stale_s))}{kWords.arms_may_move}</span>
        </div>
      )}
      {store.link.status === 'recording' && (
        <div class="banner lost" role="status" data-test="recording">
          <span><b>{kWords.recording(store.link.name)}</b> {kWords.recording_warning}</span>
          <button onClick={() => app.player.close()}>{kText.common.back_to_live}</button>
        </div>
      )}
      {store.restart !== null && store.link.status === 'open' && (
        <div class="banner" role="status" data-test="restarted"><span>{restart_in_words(store.restart, short_wall_time(store.restart.at, Date.now()))}</span><button onClick={() => store.dismiss_restart()}>{kText.common.dismiss}</button></div>
      )}
      {refusal !== null && <Fault words={refusal} test="refusal" dismiss={() => { actions.refusal.value = null; }} />}
      {drop_fault.value !== null && <Fault words={drop_fault.value} test="drop-fault" dismiss={() => { drop_fault.value = null; }} />}
      {store.cell_fault !== null && !store.cell && (
        <div class="banner error" role="alert"><span>{kWords.cell_fault(store.cell_fault)}</span></div>
      )}
    </div>
  );
}

function Fault({ words, test, dismiss }: { words: string; test: string; dismiss(): void }) {
  return <div class="banner error" role="alert" data-test={test}><span>{words}</span><button onClick={dismiss}>{kText.common.dismiss}</button></div>;
}

function Lost({ app }: { app: App }) {
  const link = app.store.link;
  const retry_in_ms = link.status === 'lost' ? link.retry_in_ms : 0;
  const [left_s, set_left_s] = useState(0);
  const stale_s = use_staleness(app.store);
  useEffect(() => {
    const until_ms = performance.now() + retry_in_ms;
    const show = () => set_left_s(Math.max(0, Math.ceil((until_ms - performance.now()) / 1000)));
    show();
    const timer = setInterval(show, 250);
    return () => clearInterval(timer);
  }, [link]);
  return (
    <div class="banner lost" role="alert" data-test="lost">
      <span>
        <b>{kWords.connection_lost}</b> {kWords.last_known_state}{stale_s !== null && <span aria-live="off">, <span data-test="age">{seconds(stale_s)}</span> {kWords.old}</span>}{kWords.arms_may_move}
        <span aria-live="off">{left_s > 0 ? kWords.retry_in(left_s) : kWords.retrying}</span>
      </span>
      <button onClick={app.actions.retry_connection}>{kWords.retry_now}</button>
    </div>
  );
}
