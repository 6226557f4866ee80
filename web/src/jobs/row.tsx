// One job in a list: arms, name, the number that matters now, and why it waits.

import { useState } from 'preact/hooks';
import { Bar } from '../arms/bar';
import { selection_of } from '../route/selection';
import { Link } from '../route/link';
import type { Job } from '../server/messages';
import type { App } from '../state/app';
import { is_terminal } from '../state/job_book';
import { arm_colour } from '../state/palette';
import { told_state } from '../state/standing';
import { use_beats } from '../state/seen';
import { figure_in_words, reason_in_words, result_in_words, short_id, title_of, why_mute } from '../wording';
import { when_in_words } from './when';
import { shown_name } from '../names';

interface Props { job: Job; app: App }

export function Row({ job, app }: Props) {
  const { store, router } = app;
  const { place } = router.address.value;
  const selection = selection_of(place, store);
  const selected = selection.jobs.includes(job.id);
  const of_arm = selection.jobs.length === 0 && job.arms.some((arm) => selection.arms.includes(arm));
  const blocker = job.waits_on.find((wait) => wait.kind === 'job' && wait.id !== null)?.id ?? null;
  const arms = [...store.arms.keys()];
  const ended = is_terminal(job);
  return (
    <article
      class={`job ${told_state(job)}${selected ? ' selected' : ''}${of_arm ? ' of-arm' : ''}`} data-test={`job-${job.id}`} data-state={job.state}
      style={{ '--arm': arm_colour(arms, job.arms[0] ?? '') }}
    >
      <Link app={app} to={selected && place.page === 'job' ? { page: 'cell' } : { page: 'job', id: job.id }} class="open" title={`Details of ${job.id}`}>
        <span class="line">
          <span class="tags">{job.arms.map((arm) => <span key={arm} class="tag" title={shown_name(arm)} style={{ '--arm': arm_colour(arms, arm) }}>{shown_name(arm)}</span>)}</span>
          <span class="ellipsis title" title={shown_name(job.name) || job.id}>{title_of(job)}</span>
          {job.priority !== 0 && <span class="priority" title="Priority: larger goes first">{job.priority > 0 ? `+${job.priority}` : job.priority}</span>}
          <span class="grow" />
          {ended && <span class="verdict">{job.state}</span>}
          <Figure job={job} app={app} />
        </span>
        {job.name !== '' && <span class="id ellipsis" title={job.id}>{job.id}</span>}
        {blocker === null && <Reason job={job} />}
        <Progress job={job} app={app} />
      </Link>
      {blocker !== null && (
        <Link app={app} to={{ page: 'pair', a: blocker, b: job.id }} class="why" test="why" title={`Show where ${job.id} and ${blocker} conflict`}>
          <Reason job={job} />
        </Link>
      )}
      {!ended && <When job={job} app={app} />}
      {waits(job) && <Urgency job={job} app={app} />}
      {!ended && <Cancel job={job} app={app} />}
    </article>
  );
}

function Progress({ job, app }: Props) {
  use_beats(app.store);
  return job.state === 'running' || job.state === 'holding' ? <Bar share={app.store.progress(job)} /> : null;
}

function Figure({ job, app }: Props) {
  if (!is_terminal(job)) use_beats(app.store);
  const { text, title } = figure_in_words(job, app.store.t_s, app.store.progress(job));
  return <span class="figure" title={title} data-test="figure">{text}</span>;
}

/** That others of its arm come first is said with its times, in one line. */
function only_waits_its_turn(job: Job): boolean {
  return job.waits_on[0]?.kind === 'order' && job.ring.length === 0 && !job.result;
}

function Reason({ job }: { job: Job }) {
  if (only_waits_its_turn(job)) return null;
  const words = job.result ? result_in_words(job) : reason_in_words(job);
  return words === '' ? null : <span class="words" data-test="reason">{words}</span>;
}

/** Since when, when it is expected to start, when it expires. */
function When({ job, app }: Props) {
  use_beats(app.store);
  const first = only_waits_its_turn(job) ? job.waits_on[0]?.id ?? null : null;
  const words = [first === null ? '' : `after ${short_id(first)}`, when_in_words(job, app.store)].filter((part) => part !== '').join(' · ');
  return words === '' ? null : <span class="when" data-test="when">{words}</span>;
}

function waits(job: Job): boolean {
  return job.state === 'queued' || job.state === 'backlogged';
}

/** Who of those that wait goes first: seen when the row is pointed at or has the focus. */
function Urgency({ job, app }: Props) {
  const mute = why_mute(app.store.link);
  const step = (by: number, sign: string, what: string) => (
    <button class="small" disabled={mute !== null} title={mute ?? `${what}: priority ${job.priority + by}`} aria-label={`${what}: ${job.id}`}
      onClick={() => { void app.actions.set_priority(job.id, job.priority + by); }}>{sign}</button>
  );
  return <div class="urgency" data-test="urgency">{step(1, '▲', 'More urgent')}{step(-1, '▼', 'Less urgent')}</div>;
}

/** The first click asks, the second does it; the question goes away by itself. */
function Cancel({ job, app }: Props) {
  const [asked, set_asked] = useState(false);
  const mute = why_mute(app.store.link);
  if (!asked) {
    return (
      <button class="cancel" disabled={job.stopping || mute !== null} title={mute ?? `Cancel ${job.id}`} aria-label={`Cancel ${job.id}`}
        onClick={() => set_asked(true)}>×</button>
    );
  }
  const moves = job.state === 'running' || job.state === 'holding';
  return (
    <div class="confirm" role="alertdialog" aria-label={`Cancel ${job.id}?`} onKeyDown={(event) => { if (event.key === 'Escape') { event.stopPropagation(); set_asked(false); } }}>
      <span>{moves ? 'It brakes on its path.' : 'Cancel this job?'}</span>
      <button class="small danger" data-test="confirm-cancel" ref={(button) => button?.focus()} onClick={() => { set_asked(false); void app.actions.cancel(job.id); }}>Cancel it</button>
      <button class="small" onClick={() => set_asked(false)}>Keep</button>
    </div>
  );
}
