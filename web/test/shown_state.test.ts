import { describe, expect, it } from 'vitest';
import type { Arm, Forecast, Job } from '../src/server/messages';
import { parse_message } from '../src/server/messages';
import { states_of } from '../src/jobs/states';
import { when_in_words } from '../src/jobs/when';
import { need_of, waiting_arms } from '../src/recovery/needs';
import { Store } from '../src/state/store';
import { known_lanes } from '../src/timeline/known';
import { lane_in_words } from '../src/timeline/mark_words';
import { arm_notes, figure_in_words } from '../src/wording';
import { arm_json, envelope, job_json, snapshot, wait_json } from './samples';

const kStop = wait_json({ kind: 'stop', id: null, arm: 'left', links: [], own_time_s: null, other_time_s: null, clearance_m: null, detail: 'operator' });
const stopped_job = (over: object = {}) => job_json('pick', { state: 'paused', started_s: 2, progress: 0.25, waits_on: [kStop], ...over }) as Job;
const arm = (over: object = {}) => arm_json('left', { state: 'paused', job: 'pick', ...over }) as Arm;

function told(store: Store, text: string): void {
  const parsed = parse_message(text);
  if (parsed.kind === 'message') store.take(parsed.message);
  else throw new Error(JSON.stringify(parsed));
}

describe('Stopped arm', () => {
  it('is shown as stopped by its job, although the server says paused, and by its needs', () => {
    expect(figure_in_words(stopped_job(), 9, 0.25).text).toBe('stopped');
    expect(figure_in_words(stopped_job({ waits_on: [wait_json()] }), 9, 0.25).text).toBe('paused');
    expect(need_of(arm({ state: 'stopped' }), stopped_job(), null)).toMatchObject({ resume: true });
    expect(need_of(arm({ state: 'moving' }), stopped_job(), null).words).toBe('Brakes on its path.');
    // Only one arm of a job of two arms was stopped. The other arm pauses with it.
    expect(need_of(arm({ name: 'right' }), stopped_job({ arms: ['left', 'right'] }), null)).toMatchObject({ resume: false });
  });

  it('is recorded with its times by its job and on the timeline', () => {
    const store = new Store(() => 0);
    told(store, snapshot(1));
    told(store, envelope('job', 2, stopped_job({ state: 'running', waits_on: [] })));
    told(store, envelope('job', 3, stopped_job({ waits_on: [wait_json()] })));
    told(store, envelope('job', 4, stopped_job()));
    told(store, envelope('arm', 5, arm({ state: 'stopped' })));
    expect(store.arms.get('left') && store.arm_state(store.arms.get('left') as Arm)).toBe('stopped');
    expect(store.book.pauses('pick')).toMatchObject([{ from_s: 3, to_s: 4, stopped: false }, { from_s: 4, to_s: null, stopped: true }]);
    told(store, envelope('job', 7, stopped_job({ state: 'running', waits_on: [] })));
    expect(store.book.pauses('pick').at(-1)).toMatchObject({ from_s: 4, to_s: 7, stopped: true });
    expect(states_of(store.job('pick') as Job, store.book.changes('pick')).map(([name]) => name)).toEqual(['submitted', 'running', 'paused', 'stopped', 'running', 'ended']);
    expect(known_lanes({ store })[0]?.marks.filter(({ kind }) => kind === 'pause').map(({ stopped }) => stopped)).toEqual([false, true]);
  });

  it('has a bounded record of pauses', () => {
    const store = new Store(() => 0);
    told(store, snapshot(1));
    for (let i = 0; i < 3000; i++) told(store, envelope('job', 2 + i, stopped_job({ state: i % 2 ? 'running' : 'paused', waits_on: [] })));
    expect(store.book.pauses('pick').length).toBeLessThanOrEqual(400);
    expect(store.book.changes('pick').length).toBeLessThanOrEqual(400);
  });
});

describe('Arm without a link to its controller', () => {
  const lost = (over: object = {}) => arm({ state: 'moving', link: 'lost', link_detail: 'connection closed', ...over });
  const store = new Store(() => 0);
  told(store, snapshot(1));
  const shown = (seq: number, told_arm: Arm) => {
    told(store, envelope('arm', seq, told_arm));
    return store.arm_state(told_arm);
  };

  it('is shown by its link, whatever its last reported state', () => {
    for (const [i, state] of (['moving', 'stopped', 'fault', 'idle'] as const).entries()) {
      expect(shown(2 + i, lost({ state }))).toBe('link lost');
      expect(shown(6 + i, lost({ state, link: 'connecting' }))).toBe('connecting');
    }
    expect(shown(10, lost({ link: 'stale' }))).toBe('moving');
  });

  it('has no progress that goes on, and a job that does not brake', () => {
    const job = stopped_job({ state: 'running', waits_on: [] });
    const braking = { ...job, stopping: true };
    told(store, envelope('job', 11, job));
    shown(12, arm({ state: 'moving' }));
    expect(store.is_braking(braking)).toBe(true);
    expect(store.progress(job)).toBeCloseTo(0.5);
    shown(13, lost());
    expect(store.is_braking(braking)).toBe(false);
    expect(store.progress(job)).toBe(0.25);
  });

  it('must be resumed if the link was lost, but not before the first connection', () => {
    const halted = (one: Arm) => waiting_arms({ arms: new Map([['left', one]]), job_of: () => null }).length > 0;
    expect(halted(lost())).toBe(true);
    expect(halted(lost({ state: 'stopped', link: 'connecting' }))).toBe(false);
    expect(halted(arm({ state: 'stopped' }))).toBe(true);
    expect(need_of(lost(), stopped_job(), null)).toMatchObject({ resume: true, words: expect.stringMatching(/Start its controller; then resume/) });
    expect(need_of(lost({ state: 'stopped', link: 'connecting' }), null, null)).toMatchObject({ resume: false, words: expect.stringMatching(/^Start its controller\./) });
  });

  it('has notes on its link, its drives and the cause of its stop', () => {
    expect(arm_notes(lost({ stop_cause: 'link lost: connection closed' }))).toEqual(['Link lost: last known position (connection closed)']);
    expect(arm_notes(lost({ link: 'connecting' }))).toEqual(['Waits for its controller; position not measured yet (connection closed)']);
    expect(arm_notes(arm({ state: 'stopped', stop_cause: 'operator', drives_on: false }))).toEqual(['Stopped: operator', 'Drives off']);
    expect(arm_notes(arm({ link: 'stale' }))).toEqual([]);
  });

  it('was stopped on the timeline from the loss of the link until the resume', () => {
    shown(20, arm({ state: 'idle' }));
    shown(21, lost());
    shown(22, arm({ state: 'stopped' }));
    shown(23, arm({ state: 'idle' }));
    expect(store.halts.get('left')?.at(-1)).toEqual({ from_s: 21, to_s: 23, stopped: true });
  });
});

// As the server predicts after a stop: no end is known.
const forecast = (now_s: number) => {
  const pauses = (at_s: number, waits_on: unknown) => [{ from_s: now_s, to_s: null, at_s, waits_on }];
  return {
    now_s, horizon_steps: 6, arms: [
      {
        name: 'left', waiting: 1, steps: [
          { id: 'pick', name: '', arms: ['left'], state: 'paused', progress: 0.25, starts_s: 2, ends_s: null, pauses: pauses(3, kStop) },
          { id: 'behind', name: '', arms: ['left'], state: 'scheduled', progress: 0, starts_s: null, ends_s: null, pauses: pauses(0, wait_json({ kind: 'predecessor', id: 'pick' })) },
        ],
      },
      {
        name: 'right', waiting: 0, steps: [
          { id: 'other', name: '', arms: ['right'], state: 'running', progress: 0.5, starts_s: 1, ends_s: now_s + 4, pauses: [] },
          { id: 'waits', name: '', arms: ['right'], state: 'scheduled', progress: 0, starts_s: null, ends_s: null, pauses: pauses(0, wait_json({ id: 'pick', arm: 'left' })) },
        ],
      },
    ],
  } as unknown as Forecast;
};

describe('Prediction for a stopped arm', () => {
  it('is described by the job and by the lane', () => {
    const store = new Store(() => 0);
    told(store, snapshot(10, { jobs: [stopped_job(), job_json('waits', { state: 'scheduled', arms: ['right'], waits_on: [wait_json({ id: 'pick' })] })], arms: [arm({ state: 'stopped' }), arm_json('right')] }));
    store.set_forecast(forecast(10));
    expect(when_in_words(store.job('pick') as Job, store)).not.toMatch(/end/);
    expect(when_in_words(store.job('waits') as Job, store)).toBe('not scheduled');
    const [left, right] = known_lanes({ store }).map((lane) => lane_in_words(lane, 10));
    expect(left).toEqual(['pick waits for resume: left is stopped (operator), until it is resumed', '2 more jobs not scheduled yet']);
    expect(right?.at(-1)).toMatch(/^waits waits .*, end unknown \(blocked\)$/);
  });
});
