// The event list, newest first: findings of the monitor and alerts of the server.

import { Link } from '../route/link';
import type { App } from '../state/app';
import type { Notice } from '../state/notices';
import { events_until } from '../state/as_of';
import { clock } from '../wording';
import { id_of, is_later } from './alerts';
import { shown_text } from '../names';
import { wall_time } from '../wall_time';
import { kText } from '../strings';

const kWords = kText.events;

export function Notices({ app }: { app: App }) {
  const { t_s } = app.router.address.value;
  const shown = app.store.notices.filter((notice) => !is_later(notice, t_s, app.store.stream));
  const open = app.alerts.open.length;
  return (
    <section class="notices" aria-label={kWords.title}>
      <div class="line head">
        <h2>{kWords.title}<span class="count">{shown.length}</span></h2>
        <span class="grow" />
        {open > 0 && <Link app={app} to={{ page: 'alerts' }} test="see-alerts">{kText.common.to_acknowledge(open)}</Link>}
      </div>
      <NoticeList app={app} />
    </section>
  );
}

const kGlyphs = { info: 'i', warning: '!', error: '✕' } as const;

export function NoticeList({ app }: { app: App }) {
  const { notices } = app.store;
  return (
    <div class="scroll" role="log" tabIndex={0} aria-label={kWords.newest_first}>
      {notices.length === 0 && <p class="none">{nothing_in_words(app)}</p>}
      {notices.map((notice) => <Line key={notice.key} notice={notice} app={app} />)}
    </div>
  );
}

/**
 * Returns the text of an empty event list. Says if older alerts, from before the page was connected
 * or from a previous session, are on the Alerts page.
 */
function nothing_in_words({ store, alerts }: App): string {
  const [first] = store.log.entries;
  if (alerts.all.length === 0 || !first || store.link.status === 'recording') return kWords.if_empty;
  return kWords.none_since(clock(first.t_s));
}

function Line({ notice, app }: { notice: Notice; app: App }) {
  const seen = app.alerts.of(id_of(notice))?.acknowledged;
  const later = is_later(notice, app.router.address.value.t_s, app.store.stream);
  return (
    <div class={`notice ${notice.level}${seen ? ' seen' : ''}${later ? ' later' : ''}`} title={later ? kWords.later : undefined}>
      <Then notice={notice} app={app} />
      <span class="glyph" aria-label={notice.level} role="img">{kGlyphs[notice.level]}</span>
      <span>{shown_text(notice.text)}</span>
    </div>
  );
}

/** The cell time of an event. A click makes all views show this time. */
export function Then({ notice, app }: { notice: Notice; app: App }) {
  const at = notice.at === null ? '' : wall_time(notice.at);
  if (!is_kept(notice, app)) return <span class="mono" title={at}>{clock(notice.t_s)}</span>;
  return (
    <button class="then mono" title={`${at === '' ? '' : `${at}. `}${kWords.show_time}`} data-test={`then-${notice.seq ?? notice.key}`}
      onClick={() => app.router.show_time(notice.t_s)}>{clock(notice.t_s)}</button>
  );
}

/** Returns true if the state at the event's time can be shown. */
function is_kept({ stream, t_s }: Notice, { store }: App): boolean {
  return (stream === null || stream === store.stream) && (store.trace.heard(t_s) === 'kept' || events_until(t_s, null, store) > 0);
}
