import { describe, expect, it } from 'vitest';
import { action_in_words, shown_steps, step_in_words, title_of_step } from '../src/jobs/steps';
import { states_of } from '../src/jobs/states';
import { step_of } from '../src/jobs/when';
import { need_of } from '../src/recovery/needs';
import { parse_job, parse_message, type Arm, type Forecast, type Job, type Step, type WaitsOn } from '../src/server/messages';
import type { Change } from '../src/state/job_book';
import { Store } from '../src/state/store';
import { figure_in_words, result_in_words, waited_for } from '../src/wording';
import { arm_json, envelope, frame, job_json, snapshot, step_json, wait_json } from './samples';

const kSteps = [
  step_json('move_to', { name: 'above', state: 'done', arms: ['left'], progress: 1 }),
  step_json('attach', { detail: 'part to left_panda_hand', state: 'done' }),
  step_json('move_to', { detail: 'to home', state: 'running', arms: ['left'], progress: 0.5 }),
  step_json('wait_io', { detail: 'free = true' }),
];

function job(over: object = {}): Job {
  const text = JSON.stringify(job_json('pick', { state: 'running', started_s: 10, steps: kSteps, step: 2, ...over }));
  const parsed = parse_job(JSON.parse(text));
  if (!parsed.ok) throw new Error(parsed.fault);
  return parsed.value;
}
const failed = (step: number, detail: string, over: object = {}) => job({
  state: 'failed', step, ended_s: 12, result: { reason: 'step_failed', detail, step },
  steps: kSteps.map((one, i) => ({ ...one, state: i < step ? 'done' : i === step ? 'failed' : 'waiting' })), ...over,
});

describe('A step', () => {
  it('is described by what it does', () => {
    const words = (kind: string, detail = '') => action_in_words({ kind, detail });
    expect(words('trajectory')).toBe('motion');
    expect(words('move_to')).toBe('motion to a goal');
    expect(words('move_to', 'to home')).toBe('motion to home');
    expect(words('gripper', 'left: 0.07 m')).toBe('gripper of left: 0.07 m');
    expect(words('attach', 'part to left_panda_hand')).toBe('attach part to left_panda_hand');
    expect(words('detach', 'part')).toBe('detach part');
    expect(words('wait_s', '0.5 s')).toBe('wait 0.5 s');
    expect(words('set_io', 'picked = true')).toBe('set picked = true');
    expect(words('wait_io', 'free = true')).toBe('wait for free = true');
  });

  it('of a newer server is shown with its kind', () => {
    expect(action_in_words({ kind: 'weld', detail: 'seam 4' })).toBe('weld: seam 4');
    expect(action_in_words({ kind: 'weld', detail: '' })).toBe('weld');
  });

  it('has its name as title, with direction characters made visible', () => {
    expect(title_of_step(step_json('move_to', { name: 'above' }) as Step)).toBe('above');
    expect(title_of_step(step_json('move_to', { name: 'a\u202eb' }) as Step)).not.toContain('\u202e');
    expect(title_of_step(step_json('detach', { detail: 'part' }) as Step)).toBe('detach part');
  });
});

describe('The steps of a job', () => {
  it('are counted from 1', () => {
    expect(step_in_words(job({ step: 0 }))).toBe('step 1 of 4: above');
    expect(step_in_words(job())).toBe('step 3 of 4: motion to home');
    expect(step_in_words(job(), true)).toBe('step 3 of 4 (motion to home)');
  });

  it('have no place after success, and none in a job without steps', () => {
    const { step: _, ...succeeded } = job({ state: 'succeeded', result: { reason: 'completed', detail: '' } });
    expect(step_in_words(succeeded)).toBeNull();
    const { steps: _steps, step: _step, ...plain } = job();
    expect(step_in_words(plain)).toBeNull();
    expect(shown_steps(plain, false)).toEqual([]);
  });

  it('are shown with the present step marked', () => {
    expect(shown_steps(job(), false).map(({ number, title, action, words, is_present }) => [number, title, action, words, is_present])).toEqual([
      [1, 'above', 'motion to a goal', 'done', false],
      [2, 'attach part to left_panda_hand', '', 'done', false],
      [3, 'motion to home', '', 'running, 50 %', true],
      [4, 'wait for free = true', '', 'waiting', false],
    ]);
  });

  it('show where the job ended, and that later steps are not done', () => {
    const words = (one: Job) => shown_steps(one, true).map(({ words, is_present }) => [words, is_present]);
    expect(words(failed(1, ''))).toEqual([['done', false], ['failed', true], ['not done', false], ['not done', false]]);
    expect(words(failed(1, '', { state: 'canceled' }))[1]).toEqual(['canceled', true]);
  });

  it('name the failed step once, in the count of the page', () => {
    expect(result_in_words(failed(1, 'step 2 of 4: part is 40 mm from the hand'))).toBe('step 2 of 4 (attach part to left_panda_hand): part is 40 mm from the hand');
    expect(result_in_words(failed(0, 'step 1 of 4 (above): no path'))).toBe('step 1 of 4 (above): no path');
    expect(result_in_words(failed(0, 'step 1 of 4 (below): other words', { result: { reason: 'no_plan', detail: 'step 1 of 4 (below): other words', step: 0 } })))
      .toBe('step 1 of 4 (above): no plan: step 1 of 4 (below): other words');
    // A job of an earlier session may have no steps any more.
    const { steps: _, ...former } = failed(1, 'step 2 of 4: gone');
    expect(result_in_words(former)).toBe('step 2: gone');
  });
});

describe('A job with steps', () => {
  const told = (over: object = {}) => {
    const store = new Store(() => 0);
    for (const text of [snapshot(1, { arms: [arm_json('left'), arm_json('right')] }), envelope('job', 10, job(over))]) {
      const parsed = parse_message(text);
      if (parsed.kind !== 'message') throw new Error(JSON.stringify(parsed));
      store.take(parsed.message);
    }
    return store;
  };
  const take = (store: Store, text: string) => {
    const parsed = parse_message(text);
    if (parsed.kind === 'message') store.take(parsed.message);
  };

  it('has as progress the share of its steps, whatever the present motion measures', () => {
    const store = told();
    take(store, frame(10.1, {}, { motions: [{ arm: 'left', job: 'pick', progress_s: 0.1, authority_s: 1 }] }));
    take(store, frame(11, {}, { motions: [{ arm: 'left', job: 'pick', progress_s: 3.9, authority_s: 4 }] }));
    expect(store.progress(job())).toBe(2.5 / 4);
    expect(store.courses.of('pick')).toBeNull();
    expect(told({ step: undefined, state: 'succeeded' }).progress(job())).toBe(2.5 / 4 + 1.5 / 4);
  });

  it('is the job of its arm also between two motions, when the arm names none', () => {
    const store = told({ state: 'paused' });
    const arm = (name: string) => store.arms.get(name) as Arm;
    expect(arm('left').job).toBeNull();
    expect(store.job_of(arm('left'))?.id).toBe('pick');
    expect(store.job_of(arm('right'))).toBeNull();
    take(store, envelope('job', 12, failed(2, '')));
    expect(store.job_of(arm('left'))).toBeNull();
    const queued = told({ state: 'queued', started_s: null });
    expect(queued.job_of(queued.arms.get('left') as Arm)).toBeNull();
  });

  it('says how long it has run, because its end is not known', () => {
    expect(figure_in_words(job(), 13.2, 0.5, 14).text).toBe('3.2 s so far');
    expect(figure_in_words(job({ state: 'paused' }), 13.2, 0.5).text).toBe('waiting');
    expect(figure_in_words(job({ state: 'paused', waits_on: [wait_json({ kind: 'stop', arm: 'left' })] }), 13.2, 0.5).text).toBe('stopped');
    const forecast = { now_s: 10, horizon_steps: 2, arms: [{ name: 'left', waiting: 0, steps: [{ id: 'pick', starts_s: 10, ends_s: 14, pauses: [] }] }] } as unknown as Forecast;
    expect(step_of(job(), forecast)).toBeNull();
    expect(step_of(job({ state: 'scheduled', started_s: null }), forecast)?.starts_s).toBe(10);
  });

  it('lists its stops, but not the pauses between its steps', () => {
    const heard = [['queued', 9], ['running', 10.01], ['paused', 11], ['running', 12], ['stopped', 13], ['running', 14]].map(([state, t_s]) => ({ state, t_s }) as Change);
    const names = (one: Job) => states_of(one, heard).map(([name]) => name);
    expect(names(job())).toEqual(['submitted', 'queued', 'started', 'stopped', 'ended']);
    const { steps: _steps, step: _step, ...plain } = job();
    expect(names(plain)).toEqual(['submitted', 'queued', 'running', 'paused', 'running', 'stopped', 'running', 'ended']);
  });

  it('waits for an action, in the words of the server', () => {
    expect(waited_for({ waits_on: [wait_json({ kind: 'action', id: null, arm: null, links: [], detail: 'waits 4 s' }) as WaitsOn] })).toBe('waits 4 s');
    expect(waited_for({ waits_on: [wait_json({ kind: 'action', id: null, arm: null, links: [] }) as WaitsOn] })).toBe('waits for an action');
  });

  it('continues after a stop at its step', () => {
    const arm = (state: string) => arm_json('left', { state }) as unknown as Arm;
    expect(need_of(arm('stopped'), job(), null).words).toMatch(/^Resume: pick continues from step 3 of 4 \(motion to home\) as soon as/);
    expect(need_of(arm('paused'), job({ step: 3 }), null)).toEqual({ words: 'pick waits at step 4 of 4 (wait for free = true). No action needed.', resume: false, home: false });
  });
});
