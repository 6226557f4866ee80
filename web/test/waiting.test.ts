import { describe, expect, it } from 'vitest';
import { blocker_of } from '../src/jobs/blocker';
import { step_of, turn_in_words, when_in_words } from '../src/jobs/when';
import { partner_of } from '../src/diagram/partner';
import { pause_in_words } from '../src/jobs/states';
import { selection_of } from '../src/route/selection';
import { parse_message, type Forecast, type Job } from '../src/server/messages';
import { kStateColors } from '../src/state/palette';
import { Store } from '../src/state/store';
import { known_lanes } from '../src/timeline/known';
import { now_in_words } from '../src/timeline/paint';
import { arm_in_words, as_last_heard, figure_in_words, reason_in_words, starvation_in_words } from '../src/wording';
import { arm_json, envelope, job_json, snapshot, wait_json } from './samples';

const crate = wait_json({ kind: 'object', id: 'crate', arm: null, links: ['left_panda_hand', 'crate'] });

function store_of(jobs: Record<string, unknown>[], arms = [arm_json('left'), arm_json('right')]): Store {
  const store = new Store(() => 0);
  const queue = { stopped: false, queued: [], backlog: [], scheduled: [], running: [] };
  for (const text of [snapshot(1, { arms, queue }), ...jobs.map((job, i) => envelope('job', i + 2, job))]) {
    const parsed = parse_message(text);
    if (parsed.kind !== 'message') throw new Error(JSON.stringify(parsed));
    store.take(parsed.message);
  }
  return store;
}
const told = (store: Store, name: string) => {
  const arm = store.arms.get(name);
  return arm ? [store.arm_state(arm), arm_in_words(arm, store)] : [];
};

describe('Arm whose next job waits', () => {
  const blocked = job_json('b', { state: 'backlogged', backlogged_s: 2, waits_on: [crate] });

  it('is shown as waiting, with the blocker', () => {
    const store = store_of([blocked]);
    expect(told(store, 'left')).toEqual(['waiting', 'waits for crate']);
    expect(told(store, 'right')).toEqual(['idle', 'idle']);
    expect(kStateColors.waiting).toBe('var(--paused)');
    expect(when_in_words(store.waiting_of('left') as Job, store)).toMatch(/^blocked for/);
  });
  it('shows its own state while it moves or is stopped', () => {
    expect(told(store_of([blocked], [arm_json('left', { state: 'stopped' }), arm_json('right')]), 'left')).toEqual(['stopped', 'stopped']);
  });
  it('is idle if its next job starts at once', () => {
    expect(told(store_of([job_json('q', { state: 'scheduled', scheduled_s: 2 }), blocked]), 'left')).toEqual(['idle', 'idle']);
  });
});

describe('Object that a job waits for', () => {
  it('is highlighted with the job, which then has no diagram partner', () => {
    const store = store_of([job_json('b', { state: 'backlogged', waits_on: [crate] }), job_json('other', { arms: ['right'] })]);
    expect(selection_of({ page: 'job', id: 'b' }, store)).toEqual({ jobs: ['b'], arms: ['left'], object: 'crate' });
    expect(partner_of(store.job('b') as Job, store)).toBeNull();
    expect(partner_of(store.job('other') as Job, store)?.id).toBe('b');
  });
});

describe('Figure of a running job', () => {
  const job = store_of([job_json('r', { state: 'running', started_s: 1, duration_s: 4 })]).job('r') as Job;

  it('is the time to the predicted end, including pauses, if known', () => {
    const forecast = { arms: [{ name: 'left', waiting: 0, steps: [{ id: 'r', ends_s: 30 }] }] } as unknown as Forecast;
    expect(figure_in_words(job, 3.4, 0.5, step_of(job, forecast)?.ends_s ?? null).text).toBe('26.6 s left');
    expect(figure_in_words(job, 3.4, 0.5, step_of({ ...job, id: 'other' }, forecast)?.ends_s ?? null).text).toBe('2.0 s left');
  });
  it('is rephrased as past when the data is old', () => {
    expect(['17.4 s left', 'waited 2.0 s', 'paused', ''].map(as_last_heard)).toEqual(['had 17.4 s left', 'had waited 2.0 s', 'was paused', '']);
    expect([true, false].map(now_in_words)).toEqual(['last data', 'now']);
  });
});

describe('Reason of a pause', () => {
  it('is remembered after the job has continued', () => {
    const at = (state: string, waits_on: object[]) => job_json('h', { state, started_s: 1, waits_on });
    const store = store_of([at('running', []), at('paused', []), at('paused', [crate]), at('running', [])]);
    const [stand] = store.book.pauses('h');
    expect(stand).toMatchObject({ from_s: 3, to_s: 5, why: { kind: 'object', id: 'crate' } });
    expect(stand && pause_in_words(stand)).toMatch(/^waited until crate is out of the way.* \(2\.0 s\)$/);
    const [mark] = known_lanes({ store }, 0).flatMap(({ marks }) => marks.filter(({ kind }) => kind === 'pause'));
    expect(mark?.waits_on?.id).toBe('crate');
  });
});

describe('Waiting job', () => {
  const bare = { links: [], own_time_s: null, other_time_s: null, clearance_m: null };
  const behind = { kind: 'predecessor', id: 'arm3-16', arm: null, ...bare };
  const forecast = (id: string, ends_s: number | null): Forecast => ({ now_s: 40, horizon_steps: 4, arms: [{ name: 'left', waiting: 0, steps: [{ id, name: '', arms: ['left'], state: 'paused', progress: 0.4, starts_s: 2, ends_s, pauses: [] }] }] }) as unknown as Forecast;

  it('names the job that goes first, how many jobs that are, and since when the arm is at rest', () => {
    const store = store_of([
      job_json('done', { state: 'succeeded', started_s: 3, ended_s: 12, submitted_s: 1 }),
      ...[14, 15, 16].map((k) => job_json(`arm3-${k}`, { arms: ['right'], state: 'scheduled', submitted_s: k / 10 })),
      job_json('arm3-17', { arms: ['right'], state: 'queued', submitted_s: 1.7 }),
      job_json('next', { submitted_s: 1.65, waits_on: [behind] }),
    ]);
    store.book.set_order({ stopped: false, running: [], scheduled: ['arm3-14', 'arm3-15', 'arm3-16'], queued: ['next', 'arm3-17'], backlog: [] });
    store.t_s = 40.7;
    const { behind: first, more } = turn_in_words(store.job('next') as Job, store);
    expect(first + more).toBe('behind arm3-16 (3 jobs), at rest 28 s');
    expect(blocker_of(store.job('next') as Job)).toEqual({ page: 'job', id: 'arm3-16' });
    expect(told(store, 'left')).toEqual(['waiting', 'behind arm3-16']);
  });

  it('says which links its end would bring together', () => {
    const reason = { ...behind, arm: 'arm3', links: ['left_link5', 'arm3_link6'], own_time_s: 4, other_time_s: 0.2, clearance_m: 0.012, detail: 'x' };
    expect(reason_in_words(store_of([job_json('j', { waits_on: [reason] })]).job('j') as Job)).toBe('waits its turn: arm3-16 of arm3 goes first: at its end left_link5 would be within 12 mm of arm3_link6');
  });

  it('is flagged if later jobs overtake it', () => {
    const job = store_of([job_json('j', { starvation: { waits_since_s: 2, bound_s: 30, overtaken_by: 9 } })]).job('j') as Job;
    expect(starvation_in_words(job)?.text).toBe('overtaken by 9 jobs');
    expect(starvation_in_words(store_of([job_json('j')]).job('j') as Job)).toBeNull();
  });

  it('has no predicted end while an object, an arm at rest or a stop blocks it', () => {
    const paused = (wait: object, over = {}) => store_of([job_json('p', { state: 'paused', started_s: 2, waits_on: [wait], ...over })]);
    const when = (store: Store, ends_s: number | null) => { store.t_s = 42; store.set_forecast(forecast('p', ends_s)); return when_in_words(store.job('p') as Job, store); };
    expect(when(paused(crate, { expires_s: 62 }), 47)).toBe('paused for 40.0 s, until crate is moved · expires in 20.0 s');
    expect(when(paused({ kind: 'arm', id: null, arm: 'right', ...bare }), 47)).toBe('paused for 40.0 s, until arm right moves away');
    expect(when(paused({ kind: 'stop', id: null, arm: 'left', ...bare }), 47)).toBe('paused for 40.0 s, until its arm is resumed');
    expect(when(paused(wait_json()), 47)).toBe('paused for 40.0 s · ends in about 5.0 s');
    expect(when(paused(wait_json(), { expires_s: 44 }), 100)).toBe('paused for 40.0 s · end unknown · expires in 2.0 s');
  });

  it('has no predicted end once it has expired', () => {
    const expired = store_of([job_json('p', { state: 'expired', started_s: 2, ended_s: 41 })]).job('p') as Job;
    expect(step_of(expired, forecast('p', 100))).toBeNull();
  });
});
