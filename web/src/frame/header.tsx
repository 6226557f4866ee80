// The header: cell, navigation, connection state, and at the right end Resume and Stop. Stop is at the
// same place on every screen and in every state.

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
import { kText } from '../strings';

const kWords = kText.frame;

export function Header({ app }: { app: App }) {
  const { store } = app;
  return (
    <header class="header">
      <Logo />
      <h1>{kWords.app}</h1>
      <span class="fact gives-way" title={shown_name(store.cell?.name ?? '')}><b data-test="cell">{shown_name(store.cell?.name ?? kWords.no_name)}</b></span>
      {store.cell?.simulated && <span class="badge" title={kWords.simulated_title} data-test="simulated">{kWords.simulated}</span>}
      <Navigation app={app} />
      <div class="facts">
        <ConnectionState app={app} />
        <ViewOnly app={app} />
        <OpenAlerts app={app} />
        <InControl app={app} />
        {store.speed !== 1 && <span class="fact"><i>{kWords.speed}</i> ×{store.speed}</span>}
        <span class="fact policy"><i>{kWords.policy}</i> <Link app={app} to={{ page: 'policies' }} test="go-policies" title={kWords.policies_title}>{store.policy || kWords.no_name}</Link></span>
        {store.policy === 'timed_discrete' && <span class="fact" data-test="no-certificate" title={kWords.no_certificate_title}>{kWords.no_certificate}</span>}
        <CellTime app={app} />
      </div>
      <div class="head-commands">
        <button class="resume" disabled={!store.stopped && waiting_arms(store).length === 0} title={kText.common.open_recovery} data-test="to-resume"
          onClick={() => app.router.go({ page: 'recovery' })}>{kText.common.resume}</button>
        <StopButton app={app} />
      </div>
    </header>
  );
}

/** States that the user is a viewer, before the user tries a command that would be refused. */
function ViewOnly({ app }: { app: App }) {
  const session = app.session.value;
  if (!is_viewer(session)) return null;
  return (
    <span class="fact gives-way" data-test="view-only" title={kWords.viewer_title(shown_name(session?.name ?? ''))}>
      <Link app={app} to={{ page: 'settings' }}>{kWords.viewer(shown_name(session?.name ?? ''))}</Link>
    </span>
  );
}

/** Shows who has control for jogging. */
function InControl({ app }: { app: App }) {
  const holder = app.jogging.holder.value;
  if (!holder) return null;
  const name = shown_name(holder.who);
  const who = app.jogging.key.value === null ? name : kWords.you(name);
  return (
    <span class="fact gives-way" data-test="in-control" title={kWords.control_since(who, wall_time(holder.since_at))}>
      {kWords.control}{holder.arm === null ? who : <Link app={app} to={{ page: 'arm', name: holder.arm }}>{who}</Link>}
    </span>
  );
}

function OpenAlerts({ app }: { app: App }) {
  const { open } = app.alerts;
  if (open.length === 0) return null;
  return (
    <Link app={app} to={{ page: 'alerts' }} class={`alert-count ${open.some(({ level }) => level === 'error') ? 'error' : ''}`} test="open-alerts" title={kWords.alerts_title}>
      {kWords.alerts(open.length)}
    </Link>
  );
}

function CellTime({ app }: { app: App }) {
  use_beats(app.store);
  const stale_s = use_staleness(app.store);
  return (
    <span class={`fact cell-time${stale_s === null ? '' : ' stale-time'}`} title={kWords.cell_time_title}>
      <i>{kWords.cell_time}</i> <span class="mono" data-test="clock">{clock(app.store.t_s)}</span>
    </span>
  );
}

function ConnectionState({ app }: { app: App }) {
  const { store } = app;
  const stale_s = use_staleness(store);
  const old = store.link.status === 'open' && stale_s !== null;
  const words = old ? (is_silent(store) ? kWords.silent_for(stale_s) : kWords.late_by(stale_s)) : kWords.link[store.link.status];
  const { unknown, malformed } = store.rejected;
  const rejected = unknown + malformed;
  return (
    <span class={`fact link-state ${old ? 'connecting' : store.link.status}`} data-test="link" title={words}>
      <span class="dot" aria-hidden="true" /> <span class="link-words">{words}</span>
      {rejected > 0 && (
        <span class="rejected" title={kWords.ignored_title(unknown, malformed)}>{kWords.ignored(rejected)}</span>
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
