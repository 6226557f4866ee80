// The top line: which cell, how it runs, whether we hear it, and Stop.

import type { Store } from '../store';
import { clock, why_mute } from '../wording';
import type { Actions } from './actions';
import { use_store } from './use_store';

export function Header({ store, actions }: { store: Store; actions: Actions }) {
  use_store(store, 'live');
  const mute = why_mute(store.link);
  return (
    <header class="header">
      <Logo />
      <h1>Armloom</h1>
      <span class="fact"><b data-test="cell">{store.cell?.name ?? '–'}</b></span>
      <span class="fact"><i>policy</i> {store.policy || '–'}</span>
      {store.speed !== 1 && <span class="fact"><i>speed</i> ×{store.speed}</span>}
      <span class="fact"><i>cell time</i> <span class="mono">{clock(store.t_s)}</span></span>
      <ConnectionState store={store} />
      <span class="spacer" />
      <button class="resume" disabled={!store.stopped || mute !== null} title={mute ?? 'Let the arms go on'}
        onClick={() => void actions.resume()}>Resume</button>
      <button class="stop" disabled={mute !== null} title={mute ?? 'Brake all arms on their paths'}
        onClick={() => void actions.stop()}>Stop</button>
    </header>
  );
}

function ConnectionState({ store }: { store: Store }) {
  const words = { connecting: 'connecting', open: 'connected', lost: 'disconnected' }[store.link.status];
  const { unknown, malformed } = store.rejected;
  const rejected = unknown + malformed;
  return (
    <span class={`fact link ${store.link.status}`} data-test="link">
      <span class="dot" /> {words}
      {rejected > 0 && (
        <span class="rejected" title={`${unknown} of unknown type, ${malformed} malformed`}> · {rejected} unread</span>
      )}
    </span>
  );
}

function Logo() {
  return (
    <svg class="logo" viewBox="0 0 24 24" fill="none" stroke-width="2.4" stroke-linecap="round" aria-hidden="true">
      <path d="M3 7c5.5 0 5.5 10 9 10s3.5-10 9-10" stroke="#56b6f2" />
      <path d="M3 17c3 0 4.3-2.9 5.5-5.5" stroke="#d59bf6" />
      <path d="M10.6 8.2C11 7.4 11.5 7 12 7c3.5 0 3.5 10 9 10" stroke="#d59bf6" />
    </svg>
  );
}
