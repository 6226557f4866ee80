// The top line: which cell, where we are, whether we hear it, and Stop, always at the right end.

import { Link } from '../route/link';
import type { App } from '../state/app';
import { is_viewer } from '../state/permission';
import { use_beats } from '../state/seen';
import { waiting_arms } from '../recovery/needs';
import { wall_time } from '../wall_time';
import { clock } from '../wording';
import { Navigation } from './navigation';
import { is_silent, use_staleness } from './staleness';
import { StopButton } from './stop_button';
import { shown_name } from '../names';

export function Header({ app }: { app: App }) {
  const { store } = app;
  return (
    <header class="header">
      <Logo />
      <h1>Armloom</h1>
      <span class="fact gives-way" title={shown_name(store.cell?.name ?? '')}><b data-test="cell">{shown_name(store.cell?.name ?? '–')}</b></span>
      {store.cell?.simulated && <span class="badge" title="The arms of this server are simulated; no drive moves" data-test="simulated">SIMULATED</span>}
      <Navigation app={app} />
      <div class="facts">
        <ConnectionState app={app} />
        <OnlyLooks app={app} />
        <OpenAlerts app={app} />
        <InControl app={app} />
        {store.speed !== 1 && <span class="fact"><i>speed</i> ×{store.speed}</span>}
        <span class="fact policy"><i>policy</i> <Link app={app} to={{ page: 'policies' }} test="go-policies" title="Policies, and what the others would have done">{store.policy || '–'}</Link></span>
        {store.policy === 'timed_discrete' && <span class="fact" data-test="no-certificate" title="This policy compares motions at time steps and certifies nothing between them. The authority guard is off.">no certificate</span>}
        <CellTime app={app} />
      </div>
      <button class="resume" disabled={!store.stopped && waiting_arms(store).length === 0} title="Leads to what is to be looked at before the arms move again" data-test="to-resume"
        onClick={() => app.router.go({ page: 'recovery' })}>Resume…</button>
      <StopButton app={app} />
    </header>
  );
}

/** Said before a command is refused. */
function OnlyLooks({ app }: { app: App }) {
  const session = app.session.value;
  if (!is_viewer(session)) return null;
  return (
    <span class="fact gives-way" data-test="only-looks" title={`${shown_name(session?.name ?? '')} is a viewer: commands take the role operator`}>
      <Link app={app} to={{ page: 'settings' }}>{shown_name(session?.name ?? '')}: may only look</Link>
    </span>
  );
}

/** Who moves arms by hand. */
function InControl({ app }: { app: App }) {
  const holder = app.hand.holder.value;
  if (!holder) return null;
  const name = shown_name(holder.who);
  const who = app.hand.key.value === null ? name : `you (${name})`;
  return (
    <span class="fact gives-way" data-test="in-control" title={`${who} has control since ${wall_time(holder.since_at)}`}>
      control: {holder.arm === null ? who : <Link app={app} to={{ page: 'arm', name: holder.arm }}>{who}</Link>}
    </span>
  );
}

function OpenAlerts({ app }: { app: App }) {
  const { open } = app.alerts;
  if (open.length === 0) return null;
  return (
    <Link app={app} to={{ page: 'alerts' }} class={`alert-count ${open.some(({ level }) => level === 'error') ? 'error' : ''}`} test="open-alerts" title="Alerts that nobody has acknowledged">
      {open.length} {open.length === 1 ? 'alert' : 'alerts'}
    </Link>
  );
}

function CellTime({ app }: { app: App }) {
  use_beats(app.store);
  const stale_s = use_staleness(app.store);
  return (
    <span class={`fact cell-time${stale_s === null ? '' : ' stale-time'}`} title="Cell time of the last thing heard">
      <i>cell time</i> <span class="mono" data-test="clock">{clock(app.store.t_s)}</span>
    </span>
  );
}

function ConnectionState({ app }: { app: App }) {
  const { store } = app;
  const stale_s = use_staleness(store);
  const old = store.link.status === 'open' && stale_s !== null;
  const words = old ? `${is_silent(store) ? 'silent for' : 'late by'} ${stale_s} s` : { connecting: 'connecting', open: 'connected', lost: 'disconnected', recording: 'recording', past: 'past' }[store.link.status];
  const { unknown, malformed } = store.rejected;
  const rejected = unknown + malformed;
  return (
    <span class={`fact link-state ${old ? 'connecting' : store.link.status}`} data-test="link" title={words}>
      <span class="dot" aria-hidden="true" /> <span class="link-words">{words}</span>
      {rejected > 0 && (
        <span class="rejected" title={`${unknown} of unknown type, ${malformed} malformed`}> · {rejected} unread</span>
      )}
    </span>
  );
}

function Logo() {
  return (
    <svg class="logo" viewBox="0 0 24 24" fill="none" stroke-width="2.4" stroke-linecap="round" aria-hidden="true">
      <path d="M3 7c5.5 0 5.5 10 9 10s3.5-10 9-10" class="thread-a" />
      <path d="M3 17c3 0 4.3-2.9 5.5-5.5" class="thread-b" />
      <path d="M10.6 8.2C11 7.4 11.5 7 12 7c3.5 0 3.5 10 9 10" class="thread-b" />
    </svg>
  );
}
