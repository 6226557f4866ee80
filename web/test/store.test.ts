import { beforeEach, describe, expect, it } from 'vitest';
import { parse_job, parse_message, type Forecast, type Job } from '../src/server/messages';
import { Store } from '../src/state/store';
import { JobBook, type JobList } from '../src/state/job_book';
import { arm_json, envelope, frame, job_json, kStream, snapshot } from './samples';

const job = (id: string, over: object): Job => {
  const parsed = parse_job(job_json(id, over));
  if (!parsed.ok) throw new Error(parsed.fault);
  return parsed.value;
};

let store: Store;

function take(text: string): void {
  const parsed = parse_message(text);
  if (parsed.kind !== 'message') throw new Error(JSON.stringify(parsed));
  store.take(parsed.message);
}

function fetched(over: object): Job {
  const parsed = parse_job(job_json('a', over));
  if (!parsed.ok) throw new Error(parsed.fault);
  return parsed.value;
}

const ids = (list: JobList) => store.jobs(list).map((job) => job.id);

beforeEach(() => {
  store = new Store();
  take(snapshot(1));
});

describe('Store', () => {
  it('moves a job between lists as its state changes', () => {
    const seen = ['queued', 'backlogged', 'scheduled', 'running', 'paused', 'running', 'succeeded'].map((state, i) => {
      take(envelope('job', 2 + i, job_json('a', { state })));
      return (['queued', 'backlog', 'scheduled', 'running', 'finished'] as const).filter((list) => ids(list).includes('a'));
    });
    expect(seen).toEqual([['queued'], ['backlog'], ['scheduled'], ['running'], ['running'], ['running'], ['finished']]);
  });

  it('keeps the server\'s order of the queue', () => {
    take(envelope('job', 2, job_json('a', { submitted_s: 1 })));
    take(envelope('job', 3, job_json('b', { submitted_s: 2, priority: 5 })));
    expect(ids('queued')).toEqual(['a', 'b']);
    take(envelope('queue', 4, { stopped: false, queued: ['b', 'a'], backlog: [], scheduled: [], running: [] }));
    expect(ids('queued')).toEqual(['b', 'a']);
  });

  it('lists finished jobs newest first and drops the oldest', () => {
    const book = new JobBook(100);
    for (let i = 0; i < 230; i++) book.take(job(`j${i}`, { state: 'succeeded', ended_s: i }), i);
    expect(book.list('finished').length).toBeLessThanOrEqual(105);
    expect(book.list('finished')[0]?.id).toBe('j229');
    expect(book.get('j29')).toBeNull();
    expect(book.get('j130')).not.toBeNull();
  });

  it('records pauses of a job, and since when it is blocked', () => {
    const book = new JobBook();
    book.take(job('a', { state: 'running' }), 1);
    book.take(job('a', { state: 'paused' }), 2);
    expect(book.pauses('a')).toMatchObject([{ from_s: 2, to_s: null, stopped: false }]);
    book.take(job('a', { state: 'running' }), 3.5);
    expect(book.pauses('a')).toMatchObject([{ from_s: 2, to_s: 3.5, stopped: false }]);
    book.take(job('b', { state: 'backlogged' }), 4);
    book.take(job('b', { state: 'backlogged' }), 5);
    expect(book.since('b')).toBe(4);
    expect(book.changes('a').map((change) => change.state)).toEqual(['running', 'paused', 'running']);
  });

  it('extrapolates progress between reports, up to the end, and not while an arm is paused', () => {
    take(envelope('job', 10, job_json('a', { state: 'running', started_s: 10, progress: 0, duration_s: 4 })));
    const progress = () => store.progress(store.job('a')!);
    take(frame(11, {}));
    expect(progress()).toBeCloseTo(0.25);
    take(frame(99, {}));
    expect(progress()).toBe(1);
    take(envelope('job', 100, job_json('a', { state: 'paused', started_s: 10, progress: 0.3, duration_s: 4 })));
    take(frame(105, {}));
    expect(progress()).toBe(0.3);
  });

  it('knows positions from frames, and from the snapshot before the first frame', () => {
    const left = store.arms.get('left')!;
    expect(store.q_of(left)).toEqual([0.1, -1.2]);
    take(frame(2, { left_panda_joint1: 0.7 }));
    expect(store.q_of(left)).toEqual([0.7, -1.2]);
  });

  it('follows a change of speed and reports it once', () => {
    take(frame(2, {}));
    let changes = 0;
    const off = store.on_change(() => { changes += 1; });
    for (const t_s of [3, 4]) take(frame(t_s, {}, { speed: 2.5 }));
    expect(store.speed).toBe(2.5);
    expect(changes).toBe(1);
    off();
  });

  it('derives the age of its data from forecasts that overtake it', () => {
    let now_ms = 0;
    store = new Store(() => now_ms);
    take(snapshot(1));
    take(frame(10, {}, { speed: 2 }));
    const forecast = (now_s: number) => store.set_forecast({ now_s, arms: [] } as unknown as Forecast);
    forecast(19);
    expect(store.age_ms()).toBe(0);  // 4.5 s of wall time, which a busy page may be late
    forecast(22);
    expect(store.age_ms()).toBe(6000);
    now_ms = 7000;
    expect(store.age_ms()).toBe(7000);
    store.set_forecast(null);
    take(frame(23, {}, { speed: 2 }));
    expect(store.age_ms()).toBe(0);
  });

  it('takes the order of the lists from a snapshot', () => {
    const queue = { stopped: false, queued: ['b', 'a'], backlog: [], scheduled: [], running: [] };
    take(snapshot(5, { jobs: [job_json('a'), job_json('b')], queue }));
    expect(ids('queued')).toEqual(['b', 'a']);
  });

  it('replaces everything by a new snapshot, and reports missed events', () => {
    take(envelope('job', 2, job_json('a')));
    take(snapshot(90, { stopped: true, jobs: [job_json('b')], gap: true }));
    expect(ids('queued')).toEqual(['b']);
    expect(store.stopped).toBe(true);
    expect(store.notices[0]?.text).toMatch(/missed/);
  });

  it('reports a restart instead of missed events', () => {
    take(envelope('job', 2, job_json('a', { state: 'running' })));
    take(snapshot(1, { gap: true }, { stream: 'another run', t_s: 0.5 }));
    expect(store.all_jobs()).toEqual([]);
    expect(store.notices.map((notice) => notice.text)).toEqual(['The server was restarted. Jobs of the previous session are in the history if the server stores jobs.']);
  });

  it('reports nothing at the first connection', () => {
    expect(store.notices).toEqual([]);
  });

  it('shows alerts with level and time', () => {
    take(envelope('alert', 2, { level: 'warning', text: 'stopped: left (operator)' }, { t_s: 4.5 }));
    take(envelope('alert', 3, { level: 'error', text: 'job a failed' }));
    expect(store.notices.map(({ level, text }) => [level, text])).toEqual([
      ['error', 'job a failed'], ['warning', 'stopped: left (operator)']]);
    expect(store.notices[1]).toMatchObject({ t_s: 4.5, source: 'alert' });
  });

  it('takes the progress of a fetched job and extrapolates it', () => {
    take(envelope('job', 10, job_json('a', { state: 'running', started_s: 10 })));
    take(frame(12, {}));
    store.refresh_job(fetched({ state: 'running', started_s: 10, progress: 0.6 }));
    expect(store.job('a')).toMatchObject({ progress: 0.6 });
    take(frame(13, {}));
    expect(store.progress(store.job('a')!)).toBeCloseTo(0.85);
  });

  it('drops a fetched job that an event has overtaken', () => {
    take(envelope('job', 10, job_json('a', { state: 'succeeded', progress: 1 })));
    store.refresh_job(fetched({ state: 'running', progress: 0.9 }));
    expect(store.job('a')?.state).toBe('succeeded');
    take(snapshot(11));
    store.refresh_job(fetched({ state: 'running', progress: 0.9 }));
    expect(store.job('a')).toBeNull();
  });

  it('adds, moves and removes scene objects', () => {
    const crate = { name: 'crate', box: [0.2, 0.2, 0.3], xyz: [0, 0.75, 0.45], rpy: [0, 0, 0] };
    const seen = [[crate], [{ ...crate, xyz: [1, 0, 0] }], []].map((objects, i) => {
      const before = store.objects;
      take(envelope('scene', 2 + i, { version: 2 + i, objects }));
      expect(store.objects).not.toBe(before);  // a new array tells the view to draw the objects again
      return store.objects.map(({ name, xyz }) => [name, ...xyz]);
    });
    expect(seen).toEqual([[['crate', 0, 0.75, 0.45]], [['crate', 1, 0, 0]], []]);
  });

  it('follows the clock of a new session, which starts at zero', () => {
    take(frame(500, {}));
    take(snapshot(1, {}, { stream: 'another run', t_s: 0.5 }));
    expect(store.t_s).toBe(0.5);
  });

  it('ranks monitor events that stopped an arm above warnings', () => {
    take(envelope('monitor', 2, { kind: 'contact', text: 'a and b touch', arms: ['left'], links: ['a', 'b'], clearance_m: 0, limit_m: 0.01, stopped: ['left'] }));
    take(envelope('monitor', 3, { kind: 'clearance', text: 'a and b are close', arms: ['left'], links: ['a', 'b'], clearance_m: 0.02, limit_m: 0.03, stopped: [] }));
    expect(store.notices.map((notice) => notice.level)).toEqual(['warning', 'error']);
  });

  it('bounds the event list', () => {
    for (let i = 0; i < 150; i++) take(envelope('alert', 2 + i, { level: 'info', text: `${i}` }));
    expect(store.notices).toHaveLength(100);
    expect(store.notices[0]?.text).toBe('149');
  });

  it('notifies listeners of changes and of frames separately', () => {
    let changes = 0;
    let frames = 0;
    store.on_change(() => { changes += 1; });
    const off = store.on_frame(() => { frames += 1; });
    take(envelope('arm', 2, arm_json('left', { state: 'moving' })));
    take(frame(3, {}));
    off();
    take(frame(4, {}));
    expect([changes, frames]).toEqual([1, 1]);
  });

  it('counts rejected messages, and names only the first', () => {
    expect([store.reject('unknown'), store.reject('unknown'), store.reject('malformed')]).toEqual([true, false, true]);
    expect(store.rejected).toEqual({ unknown: 2, malformed: 1 });
  });
});

describe('Positions from before the page was connected', () => {
  const states = (over: object = {}) => ({ stream: kStream, joints: ['a'], t_s: [1, 2, 3, 4], q: [[1], [2], [3], [4]], ...over });

  it('are those that the server kept of this session, before the page\'s own', () => {
    store.take_earlier_states(states({ stream: 'another' }));
    take(frame(3, { a: 30 }));
    expect(store.trace.first_s).toBe(3);
    store.take_earlier_states(states());
    take(frame(3.5, { a: 35 }));
    expect([store.trace.first_s, store.trace.last_s, store.trace.at(2.5), store.trace.at(3)]).toEqual([1, 3.5, { a: 2 }, { a: 30 }]);
  });

  it('fill the gap of a lost connection', () => {
    take(frame(1, { a: 10 }));
    store.set_link({ status: 'lost', attempt: 1, retry_in_ms: 1 });
    store.set_link({ status: 'open' });
    store.take_earlier_states(states());
    take(frame(3.9, { a: 39 }));
    expect([1, 1.9, 2.5, 3.5, 3.9].map((t_s) => store.trace.at(t_s)?.['a'])).toEqual([10, 10, 2, 3, 39]);
  });

  it('are not used while a recording is shown', () => {
    store.take_earlier_states(states());
    store.show_recording('run', [], { names: ['a'], t_s: [5, 6], q: [[5], [6]] });
    store.forget_all();
    take(snapshot(7));
    take(frame(7, { a: 7 }));
    expect(store.trace.first_s).toBe(7);
  });
});

describe('Stopped arms', () => {
  it('are known as stopped, with or without a job, until resumed', () => {
    take(envelope('arm', 5, arm_json('left', { state: 'stopped' })));
    take(envelope('arm', 6, arm_json('left', { state: 'stopped' })));
    take(envelope('arm', 7, arm_json('right', { state: 'stopped' })));
    take(envelope('arm', 9, arm_json('right')));
    expect(store.halts.get('left')).toEqual([{ from_s: 5, to_s: null, stopped: true }]);
    expect(store.halts.get('right')).toEqual([{ from_s: 7, to_s: 9, stopped: true }]);
  });
});
