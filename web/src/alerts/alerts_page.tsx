// Alerts, each until somebody acknowledges it, with who and when.

import type { App } from '../state/app';
import type { Notice } from '../state/store';
import { use_store } from '../state/use_store';
import { clock } from '../wording';
import { alerts_of, key_of, to_see_to } from './alerts';

export function AlertsPage({ app }: { app: App }) {
  use_store(app.store);
  const alerts = alerts_of(app);
  const open = to_see_to(app);
  const { settings, acknowledged } = app;
  const who = settings.person.value;
  const acknowledge = (some: readonly Notice[]) => acknowledged.acknowledge(some.map(key_of), who.trim() || 'somebody at this browser');
  return (
    <div class="page">
      <h2>Alerts<span class="count" data-test="alerts-open">{open.length === 0 ? 'all acknowledged' : `${open.length} to acknowledge`}</span></h2>
      <p class="hint">Warnings and errors of this run of the server. Acknowledgements are kept in this browser.</p>
      <div class="line wrap">
        <label class="line">Your name <input type="text" value={who} autocomplete="name" placeholder="who acknowledges" data-test="person" onInput={(event) => settings.set_person(event.currentTarget.value)} /></label>
        <button class="small" data-test="acknowledge-all" disabled={open.length === 0} onClick={() => acknowledge(open)}>Acknowledge all</button>
      </div>
      {alerts.length === 0 && <p class="none">None so far.</p>}
      <ul class="alerts" data-test="alerts">
        {alerts.map((notice) => <Alert key={notice.key} notice={notice} app={app} acknowledge={() => acknowledge([notice])} />)}
      </ul>
    </div>
  );
}

function Alert({ notice, app, acknowledge }: { notice: Notice; app: App; acknowledge(): void }) {
  const seen = app.acknowledged.of(key_of(notice));
  return (
    <li class={`${notice.level}${seen ? ' seen' : ''}`}>
      <span class="mono dim">{clock(notice.t_s)}</span>
      <span class="grow"><b>{notice.level === 'error' ? '✕ Error' : '! Warning'}</b> {notice.text}
        {seen && <span class="dim small"> Acknowledged by {seen.who}, {new Date(seen.at).toLocaleString()}.</span>}
      </span>
      {!seen && <button class="small" data-test="acknowledge" onClick={acknowledge}>Acknowledge</button>}
    </li>
  );
}
