// One job in a list: its arms, its name, the most relevant number, and what it waits for.

import { Bar } from '../arms/bar';
import { use_stale } from '../frame/staleness';
import type { Place } from '../route/address';
import { selection_of } from '../route/selection';
import { Link } from '../route/link';
import type { Job } from '../server/messages';
import type { App } from '../state/app';
import { is_terminal } from '../state/job_book';
import { arm_color } from '../state/palette';
import { shown_state } from '../state/shown_state';
import { use_beats } from '../state/seen';
import { as_last_heard, figure_in_words, object_of, reason_in_words, result_in_words, title_of } from '../wording';
import { Starves } from './starves';
import { StepBar, StepLine } from './step_list';
import { Cancel, is_blocked_by_object, Urgency, waits, WaysOn } from './actions';
import { known_end_of, step_of, turn_in_words, when_in_words } from './when';
import { shown_name } from '../names';
import { kText } from '../strings';

const kWords = kText.jobs;

interface Props { job: Job; app: App }

export function Row({ job, app }: Props) {
  const { store, router } = app;
  const { place } = router.address.value;
  const selection = selection_of(place, store);
  const selected = selection.jobs.includes(job.id);
  const of_arm = selection.jobs.length === 0 && job.arms.some((arm) => selection.arms.includes(arm));
  const why = reason_place(job);
  const arms = [...store.arms.keys()];
  const ended = is_terminal(job);
  return (
    <article
      class={`job ${shown_state(job)}${selected ? ' selected' : ''}${of_arm ? ' of-arm' : ''}`} data-test={`job-${job.id}`} data-state={job.state}
      style={{ '--arm': arm_color(arms, job.arms[0] ?? '') }}
    >
      <Link app={app} to={selected && place.page === 'job' ? { page: 'cell' } : { page: 'job', id: job.id }} class="open" title={kWords.details(job.id)}>
        <span class="line">
          <span class="tags">{job.arms.map((arm) => <span key={arm} class="tag" title={shown_name(arm)} style={{ '--arm': arm_color(arms, arm) }}>{shown_name(arm)}</span>)}</span>
          <span class="ellipsis title" title={shown_name(job.name) || job.id}>{title_of(job)}</span>
          {job.priority !== 0 && <span class="priority" title={kWords.priority}>{job.priority > 0 ? `+${job.priority}` : job.priority}</span>}
          <span class="grow" />
          {ended && <span class="verdict">{job.state}</span>}
          <Figure job={job} app={app} />
        </span>
        {job.name !== '' && <span class="id ellipsis" title={job.id}>{job.id}</span>}
        <StepLine job={job} />
        {why === null && <Reason job={job} />}
        <Progress job={job} app={app} />
      </Link>
      {why !== null && (
        <Link app={app} to={why} class="why" test="why" title={why.page === 'pair' ? kWords.show_conflict(job.id, why.a) : kWords.show(shown_name(why.name ?? ''))}>
          <Reason job={job} />
        </Link>
      )}
      {!ended && <When job={job} app={app} />}
      <Starves job={job} />
      {is_blocked_by_object(job, app) && <WaysOn job={job} app={app} />}
      {waits(job) && <Urgency job={job} app={app} />}
      {!ended && !is_blocked_by_object(job, app) && <Cancel job={job} app={app} />}
    </article>
  );
}

/**
 * Returns the page that explains the wait: the diagram with the blocking job, or the page of the
 * blocking object. Null if neither exists.
 */
function reason_place(job: Job): Extract<Place, { page: 'pair' | 'scene' }> | null {
  const blocker = job.waits_on.find((wait) => wait.id !== null && (wait.kind === 'job' || (wait.kind === 'predecessor' && wait.links.length > 0)))?.id ?? null;
  if (blocker !== null) return { page: 'pair', a: blocker, b: job.id };
  const object = object_of(job);
  return object === null ? null : { page: 'scene', name: object };
}

function Progress({ job, app }: Props) {
  use_beats(app.store);
  if (job.state !== 'running' && job.state !== 'paused') return null;
  const share = app.store.progress(job);
  return job.steps === undefined ? <Bar share={share} /> : <StepBar job={job} share={share} />;
}

function Figure({ job, app }: Props) {
  if (!is_terminal(job)) use_beats(app.store);
  const stale = use_stale(app.store) && !is_terminal(job);
  const { text, title } = figure_in_words({ ...job, stopping: app.store.is_braking(job) }, app.store.t_s, app.store.progress(job), known_end_of(job, step_of(job, app.store.forecast)));
  return <span class="figure" title={title} data-test="figure">{stale ? as_last_heard(text) : text}</span>;
}

/** Returns true if the job only waits its turn. This reason is shown in one line with the times. */
function only_waits_its_turn(job: Job): boolean {
  const [first] = job.waits_on;
  return first?.kind === 'predecessor' && first.links.length === 0 && job.cycle.length === 0 && !job.result;
}

function Reason({ job }: { job: Job }) {
  if (only_waits_its_turn(job)) return null;
  const words = job.result ? result_in_words(job) : reason_in_words(job);
  return words === '' ? null : <span class="words" data-test="reason">{words}</span>;
}

/** Shows how long the job has been blocked, and when it will start and expire. */
function When({ job, app }: Props) {
  use_beats(app.store);
  const turn = job.waits_on[0]?.kind === 'predecessor' && job.cycle.length === 0 ? turn_in_words(job, app.store) : null;
  const words = [turn === null ? '' : turn.behind + turn.more, when_in_words(job, app.store)].filter((part) => part !== '').join(' · ');
  const stale = use_stale(app.store);
  return words === '' ? null : <span class="when" data-test="when">{stale ? kWords.last_known(words) : words}</span>;
}
