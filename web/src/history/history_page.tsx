// The History page: a table of the jobs that have ended.

import { useEffect, useState } from 'preact/hooks';
import { matches } from '../jobs/filter';
import { Link } from '../route/link';
import type { Job } from '../server/messages';
import type { App } from '../state/app';
import { arm_color } from '../state/palette';
import { short_wall_time, wall_time } from '../wall_time';
import { clock, result_in_words, seconds, title_of, why_not_connected } from '../wording';
import { shown_name } from '../names';
import { kText } from '../strings';
import { loaded_in_words } from './loaded';

const kWords = kText.history;

const kShown = 100;

export function HistoryPage({ app }: { app: App }) {
  const [words, set_words] = useState('');
  const [only_failed, set_only_failed] = useState(false);
  const [shown, set_shown] = useState(kShown);
  const { archive } = app;
  const former = archive.jobs;
  const known = app.store.jobs('finished');
  const all = former.length === 0 ? known : [...known, ...former];
  const reach = app.store.link.status === 'recording' ? null : loaded_in_words({ received: known.length, ended_from_s: app.store.book.ended_from_s, fetched: former.length, is_all: archive.state === 'all' });
  const few = app.router.address.value.t_s === null && known.length < kShown && app.store.link.status === 'open';
  useEffect(() => { if (few) void archive.more(); }, [archive, few, app.store.stream]);
  const jobs = words === '' && !only_failed ? all : all.filter((job) => matches(job, words, only_failed));
  return (
    <div class="history">
      <section class="page" aria-label={kWords.label}>
        <h2>{kText.page.history}<span class="count">{jobs.length === all.length ? all.length : kText.jobs.of(jobs.length, all.length)}{reach === null ? '' : kWords.loaded}</span></h2>
        <div class="filter">
          <input type="search" placeholder={kWords.filter_hint} aria-label={kWords.filter_label} value={words} onInput={(event) => set_words(event.currentTarget.value)} />
          <button class="small" aria-pressed={only_failed} title={kText.jobs.failed_title} onClick={() => set_only_failed(!only_failed)}>{kText.jobs.failed}</button>
        </div>
        {reach !== null && <div class="line"><span class="dim small grow" data-test="loaded">{reach}</span><More app={app} show={() => undefined} /></div>}
        {jobs.length === 0 ? <p class="none">{none_in_words(all.length, reach !== null)}</p> : (
          <table class="history-table" data-test="history">
            <thead><tr>{kWords.columns.map((title) => <th key={title} scope="col">{title}</th>)}</tr></thead>
            <tbody>{jobs.slice(0, shown).map((job, i, lines) => <Line key={job.id} job={job} app={app} before={lines[i - 1] ?? null} />)}</tbody>
          </table>
        )}
        {jobs.length > shown ? <button class="more" onClick={() => set_shown(shown + 5 * kShown)}>{kText.common.more(jobs.length - shown)}</button> : <Earlier app={app} show={() => set_shown(shown + 5 * kShown)} />}
      </section>
    </div>
  );
}

function none_in_words(all: number, may_be_more: boolean): string {
  if (all > 0) return may_be_more ? kWords.no_match_loaded : kWords.no_match;
  return may_be_more ? kWords.if_empty_in_session : kWords.if_empty;
}

/**
 * The button that loads older jobs. They include jobs of previous sessions if the server stores
 * jobs.
 */
function More({ app: { archive, store }, show }: { app: App; show(): void }) {
  const why_disabled = why_not_connected(store.link);
  if (archive.state === 'all') return null;
  return (
    <button class="small" data-test="earlier" disabled={archive.state === 'asking' || why_disabled !== null} title={why_disabled ?? ''} onClick={() => { show(); void archive.more(); }}>
      {archive.state === 'asking' ? kWords.loading : kWords.earlier}
    </button>
  );
}

/** The line below the table: the button for older jobs, and what has been loaded. */
function Earlier({ app, show }: { app: App; show(): void }) {
  const { archive } = app;
  const status = archive.fault ? kWords.not_available(archive.fault.detail ?? archive.fault.title) : archive.state === 'all' ? kWords.all_loaded : kWords.with_data;
  return (
    <div class="line">
      <More app={app} show={show} />
      <span class="dim small" role="status" data-test="earlier-status">{status}</span>
    </div>
  );
}

/**
 * A row of the table. `before` is the row above. A divider above the first job of a previous
 * session says that times are wall-clock times from here on.
 */
function Line({ job, app, before }: { job: Job; app: App; before: Job | null }) {
  const is_former = ({ id }: Job) => app.store.job(id) === null;
  const former = is_former(job);
  const arms = [...app.store.arms.keys()];
  const waited_s = (job.started_s ?? job.ended_s ?? job.submitted_s) - job.submitted_s;
  const ran = job.started_s === null || job.ended_s === null ? kText.common.unknown_time : seconds(job.ended_s - job.started_s);
  return (
    <>
      {former && before && !is_former(before) && <tr class="divider"><td colSpan={kWords.columns.length}>{kWords.divider}</td></tr>}
      <tr class={job.state}>
        <td class="mono whole" title={wall_time(job.ended_at ?? '')}>{job.ended_s === null ? kText.common.unknown_time : former ? short_wall_time(job.ended_at ?? '', Date.now()) : clock(job.ended_s)}</td>
        <td><Link app={app} to={{ page: 'job', id: job.id }} title={job.id}>{title_of(job)}</Link></td>
        <td class="whole">{job.arms.map((arm) => <span key={arm} class="tag" title={shown_name(arm)} style={{ '--arm': arm_color(arms, arm) }}>{shown_name(arm)}</span>)}</td>
        <td class="verdict whole">{job.state}</td>
        <td class="mono whole">{seconds(waited_s)}</td>
        <td class="mono whole">{ran}</td>
        <td>{result_in_words(job)}</td>
      </tr>
    </>
  );
}
