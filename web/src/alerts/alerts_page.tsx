// Alerts, each until somebody acknowledges it, with who and when.

import type { App } from '../state/app';
import { why_not_permitted } from '../state/permission';
import { AsOf } from '../frame/as_of';
import type { KeptAlert } from '../server/messages';
import { shown_name, shown_text } from '../names';
import { short_wall_time, wall_time } from '../wall_time';
import { id_of, told_until } from './alerts';
import { Then } from './notices';

export function AlertsPage({ app }: { app: App }) {
  const { settings, alerts, actions, session } = app;
  const { t_s } = app.router.address.value;
  const all = told_until(alerts.all, t_s, app.store);
  const open = all.filter(({ acknowledged }) => acknowledged === null);
  const known_as = session.value?.name ?? null;
  const who = settings.person.value;
  const unnamed = known_as === null && who.trim() === '';
  const mute = why_not_permitted(session.value) ?? (unnamed ? 'Say who you are first' : null);
  const acknowledge = (some: readonly KeptAlert[]) => void actions.ask('Acknowledge', alerts.acknowledge(some, who.trim()));
  return (
    <div class="page">
      <h2>Alerts<span class="count" data-test="alerts-open">{all.length === 0 ? '' : open.length === 0 ? 'all acknowledged' : `${open.length} to acknowledge`}</span></h2>
      <AsOf app={app}>{app.store.link.status === 'recording' ? 'These alerts are the server\'s, and not of the recording.' : 'Who acknowledged them is told as it is now.'}</AsOf>
      <p class="hint">Warnings and errors. The server keeps who acknowledged each, and when.</p>
      {all.length > 0 && (
        <div class="line wrap">
          {known_as === null
            ? <label class="line">Your name <input type="text" value={who} maxLength={100} autocomplete="name" placeholder="who acknowledges" required aria-describedby="who-acknowledges" data-test="person" onInput={(event) => settings.set_person(event.currentTarget.value)} /></label>
            : <span>As <b>{shown_name(known_as)}</b></span>}
          <button class="small" data-test="acknowledge-all" disabled={open.length === 0 || mute !== null} title={mute ?? ''} onClick={() => acknowledge(open)}>Acknowledge all</button>
        </div>
      )}
      {unnamed && open.length > 0 && <p class="hint" id="who-acknowledges" data-test="unnamed">An alert is acknowledged by somebody: say who you are.</p>}
      {all.length === 0 && <p class="none">{t_s === null ? 'No alert so far.' : 'No alert until then.'}</p>}
      <ul class="alerts" data-test="alerts">
        {all.map((alert) => <Alert key={alert.id} alert={alert} app={app} mute={mute} acknowledge={() => acknowledge([alert])} />)}
      </ul>
    </div>
  );
}

function Alert({ alert, app, mute, acknowledge }: { alert: KeptAlert; app: App; mute: string | null; acknowledge(): void }) {
  const seen = alert.acknowledged;
  const event = app.store.notices.find((notice) => id_of(notice) === alert.id);
  return (
    <li class={`${alert.level}${seen ? ' seen' : ''}`}>
      <span class="mono dim"><time dateTime={alert.at} title={wall_time(alert.at)}>{short_wall_time(alert.at, Date.now())}</time>{event && <span class="below"><Then notice={event} app={app} /></span>}</span>
      <span class="grow"><b>{alert.level === 'error' ? '✕ Error' : '! Warning'}</b> {shown_text(alert.text)}
        {seen && <span class="dim small"> Acknowledged by {shown_name(seen.who) || 'somebody without a name'}, {wall_time(seen.at)}.</span>}
      </span>
      {!seen && <button class="small" data-test="acknowledge" disabled={mute !== null} title={mute ?? ''} onClick={acknowledge}>Acknowledge</button>}
    </li>
  );
}
