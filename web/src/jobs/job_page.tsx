// The page of one job. It shows the job's states with times, what it waits for with evidence,
// planned and measured joints, and the job as JSON, curl and Python.

import { useEffect } from 'preact/hooks';
import { pretty } from '../compose/example';
import { partner_of } from '../diagram/partner';
import { Plot, units_of } from '../plot/plot';
import { Link } from '../route/link';
import type { Job } from '../server/messages';
import type { App } from '../state/app';
import { is_terminal, type Pause } from '../state/job_book';
import { arm_color } from '../state/palette';
import { shown_state } from '../state/shown_state';
import { use_beats } from '../state/seen';
import { clock, reason_in_words, result_in_words, short_id, wait_in_words, path_in_words } from '../wording';
import { short_wall_time } from '../wall_time';
import { JobActions } from './actions';
import { asked_of, Copy } from './copy';
import { curl_of, python_of } from './snippets';
import { Starves } from './starves';
import { StepList } from './step_list';
import { states_of, pause_in_words } from './states';
import { when_in_words } from './when';
import { shown_json, shown_name } from '../names';
import { kText } from '../strings';

const kWords = kText.job;

interface Props { job: Job; app: App }

export function JobPage({ id, app }: { id: string; app: App }) {
  const looks_back = app.router.address.value.t_s !== null;
  const known = app.store.job(id);
  const job = known ?? (looks_back ? null : app.archive.get(id));
  const goes_on = !looks_back && job !== null && !is_terminal(job);
  const connected = app.store.link.status === 'open';
  const ask = job === null && connected && !looks_back;
  useEffect(() => { if (ask) void app.archive.find(id); }, [app, id, ask]);
  useEffect(() => (goes_on ? app.actions.follow_job(id) : undefined), [app, id, goes_on]);
  if (!job) return <><h2 class="ellipsis">{shown_name(id)}</h2><p class="hint">{looks_back ? kWords.unknown_then : app.store.stream === null ? kText.common.not_connected : kWords.unknown}</p></>;
  const former = known === null;
  // Waits are listed below with evidence. A deadlock cycle is stated here.
  const words = job.result ? result_in_words(job) : job.cycle.length > 0 || job.waits_on.length === 0 ? reason_in_words(job) : '';
  const arms = [...app.store.arms.keys()];
  return (
    <div class="page">
      <h2 class="ellipsis" title={shown_name(job.name) || job.id}>{shown_name(job.name) || job.id}</h2>
      <p class="hint line">
        {job.arms.map((arm) => <Link key={arm} app={app} to={{ page: 'arm', name: arm }} class="tag link-tag"><span style={{ color: arm_color(arms, arm) }}>{shown_name(arm)}</span></Link>)}
        <span class={`state-word ${shown_state(job)}`} data-test="job-state">{shown_state(job)}</span>
        <span class="mono ellipsis">{job.id}</span>
      </p>
      {words !== '' && <p class="words">{words}</p>}
      {job.waits_on.length > 0 && <Evidence job={job} app={app} />}
      <Starves job={job} />
      {job.steps !== undefined && <StepList job={job} app={app} />}
      <States job={job} app={app} />
      {path_in_words(job).map((words) => <p key={words} class="hint" data-test="path">{words}</p>)}
      {looks_back ? null : former ? <p class="hint" data-test="former">{kWords.from_store}</p> : <Beside job={job} app={app} />}
      {goes_on && <JobActions job={job} app={app} />}
      {!former && <Moves job={job} app={app} />}
      <h3>{kWords.for_programs}</h3>
      <div class="line">
        <Copy what="JSON" text={() => pretty(job)} />
        <Copy what="curl" text={() => curl_of(job, asked_of(app))} />
        <Copy what="Python" text={() => python_of(job, asked_of(app))} />
      </div>
      <pre class="mono" data-test="raw" tabIndex={0} aria-label={kWords.json_label}>{shown_json(pretty(job))}</pre>
    </div>
  );
}

function States({ job, app }: Props) {
  use_beats(app.store);
  const former = app.store.job(job.id) === null;
  const times = states_of(job, app.store.book.changes(job.id));
  const pauses = app.store.book.pauses(job.id);
  const when = is_terminal(job) ? '' : when_in_words(job, app.store);
  return (
    <>
      <ol class="states" data-test="states">
        {times.map(([name, t_s], i) => (
          <li key={i} class={t_s === null ? 'open' : ''}>
            <span>{name}</span><span class="mono" title={wall_of(job, name)}>{t_s === null ? kText.common.unknown_time : former || t_s < 0 ? short_wall_time(wall_of(job, name), Date.now()) : clock(t_s)}</span>
            <span class="dim">{t_s === null || name === kWords.submitted ? '' : `+${(t_s - job.submitted_s).toFixed(2)} s`}</span>
            <PauseReason pause={pauses.find(({ from_s }) => from_s === t_s) ?? null} />
          </li>
        ))}
      </ol>
      {job.steps === undefined
        ? <p class="hint">{kWords.trajectory(job.duration_s.toFixed(2), Math.round(100 * app.store.progress(job)), when)}</p>
        : when !== '' && <p class="hint">{when}</p>}
    </>
  );
}

/** Says why and for how long the job was paused, if known. */
function PauseReason({ pause }: { pause: Pause | null }) {
  const words = pause ? pause_in_words(pause) : '';
  return words === '' ? null : <span class="small" data-test="pause-reason">{words}</span>;
}

/**
 * Returns the wall-clock time of a state. Jobs of a previous session have only wall-clock times.
 */
function wall_of(job: Job, state: string): string {
  const at = state === kWords.submitted ? job.submitted_at : state === kWords.started ? job.started_at : job.ended_at;
  return at ?? '';
}

function Evidence({ job, app }: Props) {
  return (
    <>
      <h3 class="sr-only">{kWords.waits_for}</h3>
      <ul class="evidence" data-test="evidence-list">
        {job.waits_on.map((wait, i) => (
          <li key={i}>
            <div class="why">{wait_in_words(wait)}</div>
            {wait.kind === 'predecessor' && wait.id !== null && <Link app={app} to={{ page: 'job', id: wait.id }} test="show-first">{kText.page.job(short_id(wait.id))}</Link>}
            {wait.id !== null && wait.other_time_s !== null && <div class="dim small">{kWords.time_in_other(wait.other_time_s.toFixed(2), short_id(wait.id))}</div>}
            {wait.kind === 'object' && <Link app={app} to={{ page: 'scene', name: wait.id ?? wait.links[1] ?? null }} test="show-object">{kWords.show_in_scene}</Link>}
            {wait.id !== null && (wait.kind === 'job' || wait.links.length > 0) && <Link app={app} to={{ page: 'pair', a: wait.id, b: job.id }}>{kWords.show_conflict}</Link>}
          </li>
        ))}
      </ul>
    </>
  );
}

function Beside({ job, app }: Props) {
  const partner = partner_of(job, app.store);
  if (!partner || job.waits_on.some(({ kind, id }) => kind === 'job' && id === partner.id)) return null;
  return <p><Link app={app} to={{ page: 'pair', a: partner.id, b: job.id }} test="show-diagram">{kWords.diagram_with(short_id(partner.id))}</Link></p>;
}

/** The plot of the joints: planned positions as a pale band, measured positions as a line. */
function Moves({ job, app }: Props) {
  const { store, motions } = app;
  motions.changes.value;  // draws the plot again when the trajectory arrives
  // The server returns the trajectory of one motion; a job with steps has several.
  const planned = job.steps === undefined ? motions.of(job) : null;
  const joints = job.arms.flatMap((arm) => store.arms.get(arm)?.joints ?? []);
  const { first_s } = store.trace;
  const unseen = job.started_s !== null && (first_s === null || (job.ended_s !== null && job.ended_s < first_s));
  const from_s = job.started_s ?? Math.max(store.t_s, job.scheduled_s ?? 0);
  if (joints.length === 0 || (!planned && (unseen || job.started_s === null))) return null;
  const measured = job.started_s !== null && !unseen;
  const title = planned ? (measured ? kWords.planned_and_measured : kWords.planned) : kWords.measured;
  return (
    <>
      <h3>{title}, {units_of(joints, app)}{planned && <span class="key"><i class="band" /> {kWords.planned_key}</span>}{measured && <span class="key"><i class="stroke" /> {kWords.measured_key}</span>}</h3>
      {unseen && <p class="hint">{kWords.moved_before}</p>}
      <Plot app={app} joints={joints} planned={planned} stretch={measured ? [from_s, job.ended_s] : [0, 0]} label={kWords.joints_label(title, job.id)} />
    </>
  );
}
