// The steps of a job: as a list on its page, and as a line and a bar in its row.

import { Bar } from '../arms/bar';
import type { Job } from '../server/messages';
import type { App } from '../state/app';
import { is_terminal } from '../state/job_book';
import { arm_color, kStepGlyphs } from '../state/palette';
import { shown_name } from '../names';
import { kText } from '../strings';
import { place_of, shown_steps, step_in_words } from './steps';

// With more steps than this, the parts of the bar would be too narrow to see.
const kMostParts = 40;

/** The list of all steps. The present step is marked, or the step at which the job ended. */
export function StepList({ job, app }: { job: Job; app: App }) {
  const ended = is_terminal(job);
  const arms = [...app.store.arms.keys()];
  return (
    <>
      <h3>{kText.steps.title}<span class="count">{job.steps?.length}</span></h3>
      <ol class="steps" data-test="steps">
        {shown_steps(job, ended).map(({ number, state, title, action, words, arms: moved, is_present }) => (
          <li key={number} class={is_present ? 'present' : ''} data-state={state} aria-current={is_present ? 'step' : undefined}>
            <span class="mono dim">{number}</span>
            <span class="glyph" aria-hidden="true">{kStepGlyphs[state]}</span>
            <span class="what"><span>{title}</span>{action !== '' && <span class="dim">{kText.steps.separator}{action}</span>}</span>
            <span class="tags">{moved.map((arm) => <span key={arm} class="tag" style={{ '--arm': arm_color(arms, arm) }}>{shown_name(arm)}</span>)}</span>
            <span class="step-state">{words}</span>
          </li>
        ))}
      </ol>
    </>
  );
}

/** The present step of a job that has begun, else the number of steps. */
export function StepLine({ job }: { job: Job }) {
  if (job.steps === undefined || is_terminal(job)) return null;
  const words = job.started_s === null ? kText.steps.count(job.steps.length) : step_in_words(job);
  return <span class="step-line ellipsis" data-test="step" title={words ?? ''}>{words}</span>;
}

/** A bar with one part for each step. `share` is shown instead if the job has too many steps. */
export function StepBar({ job, share }: { job: Job; share: number }) {
  const { steps = [] } = job;
  const at = place_of(job);
  if (steps.length > kMostParts) return <Bar share={share} />;
  return <div class="bar parts" aria-hidden="true">{steps.map(({ state }, i) => <i key={i} class={i === at ? 'present' : ''} data-state={state} />)}</div>;
}
