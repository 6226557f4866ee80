// The timeline of each arm as plain data. A lane is the timeline of one arm; a mark is a motion, a
// pause or a wait in it. Past motions have the times of their jobs, future motions the times that
// the server predicts. Pure. Times are cell time.
//
// A job with steps has a motion for each step that moves the arm.
//
// An arm waits if its next job is submitted and its previous job has ended. The wait lasts until
// the next job starts. Later jobs only wait their turn and are not shown.

import type { Forecast, ForecastStep, Job, WaitsOn } from '../server/messages';
import { title_of_step } from '../jobs/steps';
import type { Pause, StepChange } from '../state/job_book';
import { kText } from '../strings';
import { title_of } from '../wording';

/** The job or arm that a job waits for. */
export interface WaitedFor { job: string | null; arm: string | null }

export interface Mark {
  /** A motion, a pause on the path, or a wait before the start. */
  kind: 'motion' | 'pause' | 'wait';
  expected: boolean;
  job: string;
  label: string;
  state: Job['state'];
  from_s: number;
  /** The end of the mark. Infinity if no end is predicted. */
  to_s: number;
  waits_on: WaitsOn | null;
  /** True if the arm is at rest until it is resumed. */
  stopped: boolean;
}

export interface Lane {
  arm: string;
  marks: Mark[];
  /** The number of the arm's jobs that have not begun and have no predicted times. */
  waiting: number;
  /** The jobs that have begun and have no predicted times: jobs with steps, after the first motion. */
  unpredicted: readonly Job[];
}

export interface Known {
  arms: readonly string[];
  /** The unfinished jobs. */
  jobs: readonly Job[];
  pasts: ReadonlyMap<string, Past>;
  pauses(job: string): readonly Pause[];
  /** When each step of a job began, as far as the page knows. */
  steps(job: string): readonly StepChange[];
  has_ended(job: string): boolean;
  forecast: Forecast | null;
  now_s: number;
}

/**
 * The marks of an arm's ended jobs, which do not change. `free_from_s` is the end of the last of
 * these jobs.
 */
export interface Past { marks: readonly Mark[]; free_from_s: number }

const kNoPast: Past = { marks: [], free_from_s: 0 };
const kLeastWait_s = 0.15;

/** The known history of jobs. */
type History = Pick<Known, 'pauses' | 'steps'>;

export function pasts_of(arms: readonly string[], ended: readonly Job[], history: History): Map<string, Past> {
  return new Map([...by_arm(arms, ended)].map(([arm, jobs]) => [arm, done_of(arm, jobs, kNoPast, Infinity, history)]));
}

export function lanes_of(known: Known): Lane[] {
  const { now_s, pasts } = known;
  const of_arm = by_arm(known.arms, known.jobs);
  return known.arms.map((arm) => {
    const expected = known.forecast?.arms.find((lane) => lane.name === arm);
    const jobs = of_arm.get(arm) ?? [];
    const done = done_of(arm, jobs, pasts.get(arm) ?? kNoPast, now_s, known);
    const steps = (expected?.steps ?? []).filter((step) => !known.has_ended(step.id));
    const timed = until_endless(steps);
    const unpredicted = jobs.filter(({ id, steps: of, started_s }) => of !== undefined && started_s !== null && steps.every((step) => step.id !== id));
    return {
      arm,
      marks: [...done.marks, ...next_of(jobs, done.free_from_s, now_s), ...timed.flatMap((step) => future_of(step, now_s))],
      waiting: Math.max(0, (expected?.waiting ?? 0) - unpredicted.length) + steps.length - timed.length,
      unpredicted,
    };
  });
}

/**
 * Cuts the list after the first step without a predicted end, because the steps after it have no
 * times.
 */
function until_endless(steps: readonly ForecastStep[]): readonly ForecastStep[] {
  const endless = steps.findIndex(({ ends_s }) => ends_s === null);
  return endless < 0 ? steps : steps.slice(0, endless + 1);
}

function by_arm(arms: readonly string[], jobs: readonly Job[]): Map<string, Job[]> {
  const of_arm = new Map<string, Job[]>(arms.map((arm) => [arm, []]));
  for (const job of jobs) for (const arm of job.arms) of_arm.get(arm)?.push(job);
  return of_arm;
}

/**
 * Returns `past` with the marks of the started jobs added. Each started job has a mark for its
 * motion, or for each of its motions, and one for the wait before it.
 */
function done_of(arm: string, jobs: readonly Job[], past: Past, now_s: number, { pauses, steps }: History): Past {
  const marks: Mark[] = [...past.marks];
  const begun = jobs.filter((job) => job.started_s !== null).sort((a, b) => (a.started_s ?? 0) - (b.started_s ?? 0));
  let { free_from_s } = past;
  for (const job of begun) {
    const start_s = job.started_s ?? 0;
    const could_s = Math.max(free_from_s, job.submitted_s);
    if (start_s - could_s > kLeastWait_s) marks.push(mark('wait', job, could_s, start_s, null));
    const end_s = job.ended_s ?? now_s;
    marks.push(...motions_of(arm, job, start_s, end_s, steps(job.id)));
    for (const { from_s, to_s, stopped, why } of pauses(job.id)) {
      marks.push({ ...mark('pause', job, from_s, to_s ?? end_s, to_s === null ? job.waits_on[0] ?? null : why), stopped });
    }
    free_from_s = Math.max(free_from_s, end_s);
  }
  return { marks, free_from_s };
}

/**
 * Returns one mark for the motion of a job. If the job has steps, returns one for each step that
 * moves the arm. The time before the first known step is one mark.
 */
function motions_of(arm: string, job: Job, start_s: number, end_s: number, begun: readonly StepChange[]): Mark[] {
  const first_s = begun[0]?.t_s ?? end_s;
  const unknown = begun.length === 0 || first_s > start_s ? [mark('motion', job, start_s, first_s, null)] : [];
  const known = begun.map(({ step, t_s }, i) => ({ step: job.steps?.[step], from_s: t_s, to_s: begun[i + 1]?.t_s ?? end_s, is_present: i === begun.length - 1 }));
  const moved = known.filter(({ step, from_s, to_s }) => step !== undefined && step.arms.length > 0 && to_s > from_s);
  return [...unknown, ...moved.flatMap(({ step, from_s, to_s, is_present }, i) => {
    if (!step?.arms.includes(arm)) return [];
    const label = kText.steps.of_job(title_of(job), title_of_step(step));
    // A job that fails at an action has failed after its last motion.
    const has_state = is_present || (job.ended_s !== null && i === moved.length - 1);
    return [{ ...mark('motion', job, from_s, to_s, null), label, state: has_state ? job.state : 'succeeded' as const }];
  })];
}

/** Returns the wait of the first job that has not started, if the arm waits for it. */
function next_of(jobs: readonly Job[], free_from_s: number, now_s: number): Mark[] {
  const next = jobs.filter((job) => job.started_s === null).sort((a, b) => a.submitted_s - b.submitted_s)[0];
  if (!next) return [];
  const could_s = Math.max(free_from_s, next.submitted_s);
  return now_s - could_s > kLeastWait_s ? [mark('wait', next, could_s, now_s, next.waits_on[0] ?? null)] : [];
}

function mark(kind: Mark['kind'], job: Job, from_s: number, to_s: number, waits_on: WaitsOn | null): Mark {
  return { kind, expected: false, job: job.id, label: job.name, state: job.state, from_s, to_s, waits_on, stopped: waits_on?.kind === 'stop' };
}

/**
 * Returns the predicted marks of one step of the forecast. Times that have passed meanwhile are
 * moved to now.
 */
function future_of(step: ForecastStep, now_s: number): Mark[] {
  const common = { expected: true, job: step.id, label: step.name, state: step.state };
  const marks: Mark[] = [];
  const add = (kind: Mark['kind'], from_s: number, to_s: number, waits_on: WaitsOn | null) => {
    if (to_s > now_s) marks.push({ ...common, kind, from_s: Math.max(now_s, from_s), to_s, waits_on, stopped: waits_on?.kind === 'stop' });
  };
  const [next] = step.pauses;
  // A stopped job has no predicted motion, only its stop.
  const stopped = next?.waits_on?.kind === 'stop' && next.to_s === null && next.from_s <= now_s;
  if (step.starts_s !== null && !stopped) add('motion', step.starts_s, step.ends_s ?? Infinity, null);
  for (const pause of step.pauses) {
    add(pause.at_s > 0 ? 'pause' : 'wait', pause.from_s, pause.to_s ?? Infinity, pause.waits_on);
  }
  return marks;
}

/**
 * Returns the marks to draw between two times. `least_s` is the duration of a pixel. Of several
 * short motions within one pixel, only the first is drawn. Failed, running and predicted motions
 * are always drawn.
 */
export function drawn_of(marks: readonly Mark[], from_s: number, to_s: number, least_s: number): Mark[] {
  const filled_to_s = new Map<Mark['kind'], number>();
  return marks.filter((mark) => {
    if (mark.to_s < from_s || mark.from_s > to_s) return false;
    if (mark.expected || mark.to_s - mark.from_s >= least_s || kAlways.has(mark.state)) return true;
    if (mark.to_s < (filled_to_s.get(mark.kind) ?? -Infinity)) return false;
    filled_to_s.set(mark.kind, mark.from_s + least_s);
    return true;
  });
}
const kAlways: ReadonlySet<Mark['state']> = new Set(['failed', 'interrupted', 'expired', 'running', 'paused']);

/** Returns the topmost mark at a time, or null. Pauses and waits are above motions. */
export function mark_at(lane: Lane, t_s: number): Mark | null {
  const there = lane.marks.filter((mark) => mark.from_s <= t_s && t_s <= mark.to_s);
  return there.find((mark) => mark.kind !== 'motion') ?? there[0] ?? null;
}
