// Alerts, each until somebody acknowledges it, with who and when.

import type { App } from '../state/app';
import type { KeptAlert } from '../server/messages';

export function AlertsPage({ app }: { app: App }) {
  const { settings, alerts, actions, session } = app;
  const { all, open } = alerts;
  const known_as = session.value?.name ?? null;
  const who = settings.person.value;
  const acknowledge = (some: readonly KeptAlert[]) => void actions.ask('Acknowledge', alerts.acknowledge(some, who.trim()));
  return (
    <div class="page">
      <h2>Alerts<span class="count" data-test="alerts-open">{open.length === 0 ? 'all acknowledged' : `${open.length} to acknowledge`}</span></h2>
      <p class="hint">Warnings and errors. The server keeps who has seen to them, and when.</p>
      <div class="line wrap">
        {known_as === null
          ? <label class="line">Your name <input type="text" value={who} maxLength={100} autocomplete="name" placeholder="who acknowledges" data-test="person" onInput={(event) => settings.set_person(event.currentTarget.value)} /></label>
          : <span>As <b>{known_as}</b></span>}
        <button class="small" data-test="acknowledge-all" disabled={open.length === 0} onClick={() => acknowledge(open)}>Acknowledge all</button>
      </div>
      {all.length === 0 && <p class="none">None so far.</p>}
      <ul class="alerts" data-test="alerts">
        {all.map((alert) => <Alert key={alert.id} alert={alert} acknowledge={() => acknowledge([alert])} />)}
      </ul>
    </div>
  );
}

function Alert({ alert, acknowledge }: { alert: KeptAlert; acknowledge(): void }) {
  const seen = alert.acknowledged;
  return (
    <li class={`${alert.level}${seen ? ' seen' : ''}`}>
      <span class="mono dim">{new Date(alert.at).toLocaleTimeString()}</span>
      <span class="grow"><b>{alert.level === 'error' ? '✕ Error' : '! Warning'}</b> {alert.text}
        {seen && <span class="dim small"> Acknowledged by {seen.who}, {new Date(seen.at).toLocaleString()}.</span>}
      </span>
      {!seen && <button class="small" data-test="acknowledge" onClick={acknowledge}>Acknowledge</button>}
    </li>
  );
}
