// The steps of a job in words. Pure. Steps are counted from 1 on the page; the API counts from 0.

import type { Job, Step } from '../server/messages';
import { shown_name, shown_text } from '../names';
import { kText } from '../strings';

const kWords = kText.steps;

type Stepped = Pick<Job, 'steps' | 'step' | 'result'>;

/** Returns what a step does: "attach part to left_panda_hand". */
export function action_in_words({ kind, detail }: Pick<Step, 'kind' | 'detail'>): string {
  const what = shown_text(detail);
  switch (kind) {
    case 'trajectory': return kWords.motion;
    case 'move_to': return what === '' ? kWords.motion_to_goal : kWords.motion_to(what);
    case 'gripper': return kWords.gripper(what);
    case 'attach': return kWords.attach(what);
    case 'detach': return kWords.detach(what);
    case 'wait_s': return kWords.wait(what);
    case 'set_io': return kWords.set(what);
    case 'wait_io': return kWords.wait_for(what);
    default: return kWords.other(shown_text(kind), what);  // of a newer server
  }
}

/** Returns the step's name, or what it does if it has no name. */
export function title_of_step(step: Pick<Step, 'name' | 'kind' | 'detail'>): string {
  return shown_name(step.name) || action_in_words(step);
}

/** Returns the index of the present step, or of the step at which the job ended. Null if neither. */
export function place_of({ step, result }: Pick<Job, 'step' | 'result'>): number | null {
  return step ?? result?.step ?? null;
}

/**
 * Returns "step 3 of 8: place", or in a sentence "step 3 of 8 (place)". Null if the job has no steps,
 * or has succeeded.
 */
export function step_in_words(job: Stepped, in_sentence = false): string | null {
  const at = place_of(job);
  const step = at === null ? undefined : job.steps?.[at];
  if (at === null) return null;
  if (!step || !job.steps) return kWords.at_unknown_step(at + 1);
  const words = in_sentence ? kWords.at_step_in_sentence : kWords.at_step;
  return words(at + 1, job.steps.length, title_of_step(step));
}

/**
 * Returns the reason that the server gives for the end of a job, without the step at its beginning:
 * the page names the step itself.
 */
export function detail_without_step({ steps, result }: Stepped): string {
  const detail = result?.detail ?? '';
  if (result?.step === undefined) return detail;
  const name = steps?.[result.step]?.name ?? '';
  const begin = `step ${result.step + 1} of ${steps?.length ?? /^step \d+ of (\d+)/.exec(detail)?.[1] ?? ''}${name === '' ? '' : ` (${name})`}: `;
  return detail.startsWith(begin) ? detail.slice(begin.length) : detail;
}

/** A step as the page shows it. */
export interface ShownStep {
  number: number;
  state: Step['state'];
  title: string;
  /** The action, if the title is a name. Else empty. */
  action: string;
  words: string;
  arms: readonly string[];
  /** True if this is the present step, or the step at which the job ended. */
  is_present: boolean;
}

/** Returns the steps of a job. `ended` is true if the job has ended: later steps are not done. */
export function shown_steps(job: Pick<Job, 'steps' | 'step' | 'result' | 'state'>, ended: boolean): ShownStep[] {
  const at = place_of(job);
  return (job.steps ?? []).map((step, i) => {
    const title = title_of_step(step);
    const action = action_in_words(step);
    return { number: i + 1, state: step.state, title, action: action === title ? '' : action, words: state_in_words(step, job.state, ended), arms: step.arms, is_present: at === i };
  });
}

function state_in_words({ state, progress }: Step, of_job: Job['state'], ended: boolean): string {
  if (state === 'running' && progress > 0) return kWords.running(Math.round(100 * progress));
  if (state === 'failed') return of_job;  // the job may also have been canceled or interrupted at this step
  return state === 'waiting' && ended ? kWords.not_done : state;
}
