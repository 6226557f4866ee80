import { beforeEach, describe, expect, it } from 'vitest';
import { is_later } from '../src/alerts/alerts';
import { Router } from '../src/route/router';
import { parse_message, type Job, type SequencedMessage } from '../src/server/messages';
import { events_until, Seen, state_after } from '../src/state/as_of';
import { JobBook } from '../src/state/job_book';
import { Store } from '../src/state/store';
import { arm_json, envelope, frame, job_json, snapshot } from './samples';

let store: Store;

function read(text: string) {
  const parsed = parse_message(text);
  if (parsed.kind !== 'message') throw new Error(JSON.stringify(parsed));
  return parsed.message;
}
const take = (...texts: string[]) => { for (const text of texts) store.take(read(text)); };
const earlier = (...texts: string[]) => store.take_earlier(texts.map((text) => read(text) as SequencedMessage));

const at = (t_s: number) => state_after(events_until(t_s, null, store), store);
const arm_at = (t_s: number, name = 'left') => {
  const then = at(t_s);
  const arm = then.arms.get(name);
  return arm ? [then.arm_state(arm), arm.job] : null;
};
const finished_at = (t_s: number) => at(t_s).jobs('finished').map(({ id }) => id);

/**
 * Each event's number is its time in seconds. A job runs from 10 to 20, and an alert is raised at
 * 25.
 */
const kStory = [
  envelope('job', 9, job_json('a', { submitted_s: 9 })),
  envelope('job', 10, job_json('a', { submitted_s: 9, state: 'running', started_s: 10 })),
  envelope('arm', 11, arm_json('left', { state: 'moving', job: 'a' })),
  envelope('job', 20, job_json('a', { submitted_s: 9, state: 'succeeded', started_s: 10, ended_s: 20, result: { reason: 'completed', detail: '' } })),
  envelope('arm', 21, arm_json('left')),
  envelope('alert', 25, { level: 'warning', text: 'Somebody stands there' }),
  envelope('queue', 26, { stopped: true, queued: [], backlog: [], scheduled: [], running: [] }),
];

beforeEach(() => { store = new Store(() => 0); });

describe('Past state', () => {
  beforeEach(() => take(snapshot(5), ...kStory));

  it('shows what arms did then, not what they do now', () => {
    expect([7, 12, 30].map((t_s) => arm_at(Math.min(t_s, store.t_s)))).toEqual([['idle', null], ['moving', 'a'], ['idle', null]]);
  });

  it('has each job in its list at that time', () => {
    expect(at(8).all_jobs()).toEqual([]);
    expect(at(9.5).jobs('queued')).toHaveLength(1);
    expect(at(15).jobs('running').map(({ id }) => id)).toEqual(['a']);
    expect(finished_at(19)).toEqual([]);
    expect(finished_at(20)).toEqual(['a']);
  });

  it('has the progress of a job at that time', () => {
    const then = at(11);
    then.look_at(12);
    const job = then.job('a');
    expect(job && then.progress(job)).toBeCloseTo(0.5);
  });

  it('knows whether the cell was stopped, and marks later events', () => {
    expect([at(25).stopped, at(26).stopped]).toEqual([false, true]);
    const [event] = store.events;
    expect(event && [24, 25, null].map((t_s) => is_later(event, t_s, store.stream))).toEqual([true, false, false]);
  });

  it('is unknown before the first data, in the future, and in another session', () => {
    for (const then of [at(3), at(99), state_after(events_until(12, 'ffffffff', store), store)]) {
      expect([...then.arms.values()].map((arm) => then.arm_state(arm))).toEqual(['not known', 'not known']);
      expect([then.all_jobs(), then.stream]).toEqual([[], null]);
    }
  });

  it('is unknown where events were lost', () => {
    take(frame(26, {}));
    store.trace.break_off();
    take(snapshot(40, { gap: true }), frame(40.1, {}));
    expect(events_until(33, null, store)).toBe(0);
    expect(events_until(40, null, store)).toBeGreaterThan(0);
  });

  it('leaves the present unchanged', () => {
    at(12);
    expect([store.jobs('finished').length, store.stopped, store.log.entries.length]).toEqual([1, true, 8]);
  });

  it('follows the address, and is the present without a time', () => {
    let hash = '#/';
    const router = new Router({ read: () => hash, push: (to) => { hash = to; }, replace: (to) => { hash = to; }, on_change: () => undefined }, () => store.stream);
    const seen = new Seen(store, router);
    expect(seen.store.value).toBe(store);
    router.show_time(12);
    const then = seen.store.value;
    expect(then.jobs('running')).toHaveLength(1);
    router.show_time(13);  // no event lies between this time and the last
    expect(seen.store.value).toBe(then);
    expect(then.t_s).toBe(13);
    router.show_time(22);
    expect(seen.store.value.jobs('running')).toHaveLength(0);
    router.show_time(null);
    expect(seen.store.value).toBe(store);
  });
});

describe('Events from before the page was loaded', () => {
  beforeEach(() => {
    take(snapshot(30, { jobs: [job_json('a', { submitted_s: 9, state: 'succeeded', started_s: 10, ended_s: 20 }), job_json('old', { submitted_s: 1, state: 'succeeded', started_s: 1, ended_s: 2 })] }));
    earlier(...kStory);
  });

  it('appear in the event list once', () => {
    earlier(...kStory.slice(0, 0));
    expect(store.events.map(({ text }) => text)).toEqual(['Somebody stands there']);
  });

  it('determine past states; the rest is taken from the snapshot', () => {
    expect(arm_at(12)).toEqual(['moving', 'a']);
    expect(arm_at(12, 'right')).toEqual(['idle', null]);
    expect(finished_at(12)).toEqual(['old']);
    expect([...at(12).arms.keys()]).toEqual(['left', 'right']);
  });

  it('leave arms unknown before the first event that names them', () => {  // the events do not begin with the session
    expect(arm_at(9)?.[0]).toBe('not known');
  });

  it('are ignored if they are of another session or already known', () => {
    const before = store.log.entries.length;
    earlier(envelope('alert', 2, { level: 'info', text: 'x' }, { stream: 'other' }), envelope('alert', 31, { level: 'info', text: 'y' }));
    expect(store.log.entries).toHaveLength(before);
  });
});

it('stay in effect when the bounded log folds them', () => {
  take(snapshot(1));
  const moves = [0, 1].map((i) => read(envelope('arm', 2, arm_json('left', { state: i === 0 ? 'moving' : 'idle' }))) as SequencedMessage);
  for (let i = 0; i < 25_000; i++) store.take({ ...moves[i % 2], seq: 2 + i, t_s: 2 + i * 0.001 } as SequencedMessage);
  expect(store.log.entries.length).toBeLessThanOrEqual(20_001);
  take(envelope('alert', 30_000, { level: 'info', text: 'late' }, { t_s: 2000 }));
  expect(store.log.entries.length).toBeLessThanOrEqual(3);
  expect(arm_at(2000)?.[0]).toBe('idle');
});

describe('Time from which ended jobs are complete', () => {
  const ended = (count: number, last_s = 500) => Array.from({ length: count }, (_, i) => job_json(`e${i}`, { state: 'succeeded', started_s: 1, ended_s: last_s - i }));

  it('is the begin of the session if the snapshot is not full', () => {
    take(snapshot(30, { jobs: ended(199) }));
    expect(store.book.ended_from_s).toBeNull();
  });

  it('is the oldest ended job if the snapshot is full', () => {
    take(snapshot(30, { jobs: ended(200) }));
    expect(store.book.ended_from_s).toBe(301);
    take(envelope('job', 31, job_json('next', { state: 'succeeded', started_s: 1, ended_s: 501 }), { t_s: 501 }));
    expect([store.book.ended_from_s, store.jobs('finished').length]).toEqual([301, 201]);
  });

  it('is the same or earlier in past states', () => {
    const [first_s, last_s] = [400, 500];
    take(snapshot(130, { jobs: ended(200) }, { t_s: last_s }));
    earlier(...Array.from({ length: 101 }, (_, i) => envelope('job', 30 + i, ended(101, last_s)[100 - i], { t_s: first_s + i })));
    expect([at(450).jobs('finished').length, at(450).book.ended_from_s]).toEqual([150, 301]);
  });

  it('moves forward when the oldest jobs are dropped', () => {
    const book = new JobBook(10);
    for (let i = 1; i <= 11; i++) book.take(job_json(`e${i}`, { state: 'succeeded', ended_s: i }) as unknown as Job, i);
    expect([book.list('finished').length, book.ended_from_s]).toEqual([10, 2]);
  });
});
