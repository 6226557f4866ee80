// The Alerts page: each alert until it is acknowledged, then who acknowledged it and when.

import type { App } from '../state/app';
import { why_not_permitted } from '../state/permission';
import { AsOf } from '../frame/as_of';
import type { KeptAlert } from '../server/messages';
import { shown_name, shown_text } from '../names';
import { short_wall_time, wall_time } from '../wall_time';
import { id_of, reported_until } from './alerts';
import { kText } from '../strings';
import { Then } from './notices';

const kWords = kText.alerts;

export function AlertsPage({ app }: { app: App }) {
  const { settings, alerts, actions, session } = app;
  const { t_s } = app.router.address.value;
  const all = reported_until(alerts.all, t_s, app.store);
  const open = all.filter(({ acknowledged }) => acknowledged === null);
  const known_as = session.value?.name ?? null;
  const who = settings.person.value;
  const unnamed = known_as === null && who.trim() === '';
  const why_disabled = why_not_permitted(session.value) ?? (unnamed ? kWords.name_first : null);
  const acknowledge = (some: readonly KeptAlert[]) => void actions.ask(kWords.acknowledge, alerts.acknowledge(some, who.trim()));
  return (
    <div class="page">
      <h2>{kText.page.alerts}<span class="count" data-test="alerts-open">{all.length === 0 ? '' : open.length === 0 ? kWords.all_acknowledged : kText.common.to_acknowledge(open.length)}</span></h2>
      <AsOf app={app}>{app.store.link.status === 'recording' ? kWords.of_live_server : kWords.acknowledgements_now}</AsOf>
      <p class="hint">{kWords.hint}</p>
      {all.length > 0 && (
        <div class="line wrap">
          {known_as === null
            ? <label class="line">{kText.common.your_name} <input type="text" value={who} maxLength={100} autocomplete="name" placeholder={kWords.name_hint} required aria-describedby="who-acknowledges" data-test="person" onInput={(event) => settings.set_person(event.currentTarget.value)} /></label>
            : <span>{kWords.acknowledging_as} <b>{shown_name(known_as)}</b></span>}
          <button class="small" data-test="acknowledge-all" disabled={open.length === 0 || why_disabled !== null} title={why_disabled ?? ''} onClick={() => acknowledge(open)}>{kWords.acknowledge_all}</button>
        </div>
      )}
      {unnamed && open.length > 0 && <p class="hint" id="who-acknowledges" data-test="unnamed">{kWords.needs_name}</p>}
      {all.length === 0 && <p class="none">{t_s === null ? kWords.if_empty : kWords.if_empty_then}</p>}
      <ul class="alerts" data-test="alerts">
        {all.map((alert) => <Alert key={alert.id} alert={alert} app={app} why_disabled={why_disabled} acknowledge={() => acknowledge([alert])} />)}
      </ul>
    </div>
  );
}

function Alert({ alert, app, why_disabled, acknowledge }: { alert: KeptAlert; app: App; why_disabled: string | null; acknowledge(): void }) {
  const seen = alert.acknowledged;
  const event = app.store.notices.find((notice) => id_of(notice) === alert.id);
  return (
    <li class={`${alert.level}${seen ? ' seen' : ''}`}>
      <span class="mono dim"><time dateTime={alert.at} title={wall_time(alert.at)}>{short_wall_time(alert.at, Date.now())}</time>{event && <span class="below"><Then notice={event} app={app} /></span>}</span>
      <span class="grow"><b>{alert.level === 'error' ? kWords.error : kWords.warning}</b> {shown_text(alert.text)}
        {seen && <span class="dim small">{kWords.acknowledged_by(shown_name(seen.who) || kWords.unnamed, wall_time(seen.at))}</span>}
      </span>
      {!seen && <button class="small" data-test="acknowledge" disabled={why_disabled !== null} title={why_disabled ?? ''} onClick={acknowledge}>{kWords.acknowledge}</button>}
    </li>
  );
}
