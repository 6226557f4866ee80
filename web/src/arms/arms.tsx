// One card for each arm, with its state, job and progress. The card links to the arm's page.

import { Link } from '../route/link';
import { selection_of } from '../route/selection';
import { blocker_of } from '../jobs/blocker';
import { Starves } from '../jobs/starves';
import { StepBar } from '../jobs/step_list';
import { place_of } from '../jobs/steps';
import { turn_in_words } from '../jobs/when';
import type { Arm, Job } from '../server/messages';
import type { App } from '../state/app';
import { arm_color, kStateColors, kStateGlyphs } from '../state/palette';
import { use_beats } from '../state/seen';
import { shown_name } from '../names';
import { arm_notes, reason_in_words, short_id, title_of, until_in_words } from '../wording';
import { kText } from '../strings';
import { Bar } from './bar';
import { SpeedSlider } from './speed_slider';

export function Arms({ app }: { app: App }) {
  const arms = [...app.store.arms.values()];
  return (
    <section class={`arms${arms.length > 4 ? ' many' : ''}`} aria-label={kText.arm.arms}>
      <SpeedSlider app={app} arm={null} told={app.store.speed_override} />
      <div class="cards">
        {arms.map((arm) => <ArmCard key={arm.name} arm={arm} app={app} />)}
      </div>
    </section>
  );
}

function ArmCard({ arm, app }: { arm: Arm; app: App }) {
  use_beats(app.store);
  const { store } = app;
  const job = store.job_of(arm);
  const waiting = !job && store.arm_state(arm) === 'waiting' ? store.waiting_of(arm.name) : null;
  const blocked = waiting ?? (job?.state === 'paused' && job.waits_on.length > 0 ? job : null);
  const progress = job ? store.progress(job) : 0;
  const at = job && job.steps !== undefined ? place_of(job) : null;
  const lit = selection_of(app.router.address.value.place, store).arms.includes(arm.name);
  return (
    <div class={`card${lit ? ' lit' : ''}`} data-test={`arm-${arm.name}`}
      style={{ '--arm': arm_color([...store.arms.keys()], arm.name), '--state': kStateColors[store.arm_state(arm)] }}>
      <Link app={app} to={{ page: 'arm', name: arm.name }} class="card-link" title={kText.arm.details_of(shown_name(arm.name))}>
        <span class="line">
          <span class="swatch" aria-hidden="true" />
          <b class="grow ellipsis">{shown_name(arm.name)}</b>
          <StatePill arm={arm} app={app} />
        </span>
        <span class="line dim job-of-arm">
          {waiting ? <span class="grow ellipsis">{title_of(waiting)}</span> : <span class="grow ellipsis">{job ? title_of(job) : arm.job ? short_id(arm.job) : store.arm_state(arm) === 'not known' ? kText.arm.unknown_then : kText.arm.no_job}</span>}
          <span class={at === null ? 'mono' : 'whole'}>{at !== null ? kText.steps.place(at + 1, job?.steps?.length ?? 0) : job ? `${Math.round(100 * progress)} %` : ''}</span>
        </span>
        {!waiting && (at !== null && job ? <StepBar job={job} share={progress} /> : <Bar share={progress} />)}
      </Link>
      <ArmNotes arm={arm} />
      {blocked && <Waiting job={blocked} app={app} />}
      <Holds arm={arm.name} app={app} />
      <SpeedSlider app={app} arm={arm.name} told={arm.speed_override ?? 1} effective={arm.effective_speed_override} />
    </div>
  );
}

/** Shows what the arm's next job waits for, with a link to it, and since when. */
function Waiting({ job, app }: { job: Job; app: App }) {
  const turn = turn_in_words(job, app.store);
  const until = job.state === 'paused' ? until_in_words(job) : '';
  const { behind, more } = until === '' ? turn : { behind: until, more: '' };
  const to = blocker_of(job) ?? { page: 'job', id: job.id };
  return (
    <p class={`waiting small${more === '' ? ' alone' : ''}`} data-test="arm-waits" title={`${title_of(job)}: ${reason_in_words(job)}`}>
      <Link app={app} to={to} test="arm-waits-for">{behind}</Link>{more}
      <Starves job={job} />
    </p>
  );
}

/** Shows which objects an arm holds, with links to them. Shows nothing if it holds none. */
export function Holds({ arm, app, in_sentence = false }: { arm: string; app: App; in_sentence?: boolean }) {
  const objects = app.store.holds(arm);
  if (objects.length === 0) return null;
  return (
    <p class="holds small" data-test="arm-holds">
      {in_sentence ? kText.arm.holds_sentence : kText.arm.holds}{' '}
      {objects.map((name, i) => <span key={name}>{i > 0 && ', '}<Link app={app} to={{ page: 'scene', name }}>{shown_name(name)}</Link></span>)}
    </p>
  );
}

/** Shows what the state does not say: the link, the cause of a stop, the drives. */
export function ArmNotes({ arm }: { arm: Arm }) {
  return <>{arm_notes(arm).map((words) => <p key={words} class="note small" data-test="arm-note">{words}</p>)}</>;
}

export function StatePill({ arm, app }: { arm: Arm; app: App }) {
  const state = app.store.arm_state(arm);
  return <span class="pill" data-test="arm-state" style={{ '--state': kStateColors[state] }}><span aria-hidden="true">{kStateGlyphs[state]}</span> {state}{arm.link === 'stale' && <i title={kText.arm.stale_title}>{kText.arm.stale}</i>}</span>;
}
