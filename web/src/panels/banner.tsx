// The line under the header: connection lost, cell unreadable, or a refused request.

import { useEffect, useState } from 'preact/hooks';
import type { Store } from '../store';
import type { Actions } from './actions';
import { use_store } from './use_store';

export function Banner({ store, actions }: { store: Store; actions: Actions }) {
  use_store(store);
  const refusal = actions.refusal.value;
  if (store.link.status === 'lost') return <Lost store={store} actions={actions} />;
  if (refusal) {
    return (
      <div class="banner error" role="alert">
        <span>{refusal}</span>
        <button onClick={() => { actions.refusal.value = null; }}>Dismiss</button>
      </div>
    );
  }
  if (store.cell_fault && !store.cell) {
    return <div class="banner error" role="alert"><span>The cell cannot be shown: {store.cell_fault}</span></div>;
  }
  return null;
}

function Lost({ store, actions }: { store: Store; actions: Actions }) {
  const link = store.link;
  const retry_in_ms = link.status === 'lost' ? link.retry_in_ms : 0;
  const [left_s, set_left_s] = useState(0);
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
        <b>Connection lost.</b> What you see is the last known state; arms may still be moving.
        {left_s > 0 ? ` Trying again in ${left_s} s.` : ' Trying again…'}
      </span>
      <button onClick={actions.retry_connection}>Try now</button>
    </div>
  );
}
