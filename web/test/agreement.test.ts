import { effect } from '@preact/signals';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { address_on_server } from '../src/server/api';
import { parse_message, type Message, type SequencedMessage } from '../src/server/messages';
import { seen } from '../src/state/seen';
import { Store } from '../src/state/store';
import { known_lanes } from '../src/timeline/known';
import { arm_json, envelope, frame, job_json, snapshot, wait_json } from './samples';

function read(text: string): Message {
  const parsed = parse_message(text);
  if (parsed.kind !== 'message') throw new Error(JSON.stringify(parsed));
  return parsed.message;
}

const stop = wait_json({ kind: 'stop', id: null, arm: 'left', links: [], own_time_s: null, other_time_s: null, clearance_m: null });
const begun = { submitted_s: 2, scheduled_s: 2, started_s: 3, duration_s: 9 };
const ended = { ...begun, state: 'succeeded', ended_s: 19, result: { reason: 'completed', detail: '' } };

/**
 * Each event's number is its time in seconds. `a` pauses for another job from 5 to 7, is stopped from 10
 * to 15, and ends at 19. `b` pauses from 21 on.
 */
const kStory = [
  envelope('job', 2, job_json('a', { submitted_s: 2 })),
  envelope('job', 3, job_json('a', { ...begun, state: 'running' })),
  envelope('arm', 4, arm_json('left', { state: 'moving', job: 'a' })),
  envelope('job', 5, job_json('a', { ...begun, state: 'paused', waits_on: [wait_json()] })),
  envelope('job', 7, job_json('a', { ...begun, state: 'running' })),
  envelope('job', 10, job_json('a', { ...begun, state: 'paused', waits_on: [stop] })),
  envelope('arm', 11, arm_json('left', { state: 'stopped', job: 'a' })),
  envelope('arm', 14, arm_json('left', { state: 'moving', job: 'a' })),
  envelope('job', 15, job_json('a', { ...begun, state: 'running' })),
  envelope('job', 19, job_json('a', ended)),
  envelope('job', 20, job_json('b', { submitted_s: 3, scheduled_s: 3, started_s: 20, duration_s: 9, state: 'running' })),
  envelope('job', 21, job_json('b', { submitted_s: 3, scheduled_s: 3, started_s: 20, duration_s: 9, state: 'paused', waits_on: [wait_json()] })),
];
const kLast = job_json('b', { submitted_s: 3, scheduled_s: 3, started_s: 20, duration_s: 9, state: 'paused', waits_on: [wait_json()] });

describe('Timeline after a reload', () => {
  const drawn = (store: Store) => ({ lanes: known_lanes({ store }, 0), halts: [...store.halts] });

  it('shows the same motions, pauses, stops and waits as before', () => {
    const watching = new Store(() => 0);
    for (const text of [snapshot(1), ...kStory, frame(25, {})]) watching.take(read(text));
    const pauses = drawn(watching).lanes.flatMap(({ marks }) => marks).filter(({ kind }) => kind === 'pause');
    expect(pauses.map(({ job, from_s, to_s, stopped }) => [job, from_s, to_s, stopped])).toEqual([['a', 5, 7, false], ['a', 10, 15, true], ['b', 21, 25, false]]);

    const reloaded = new Store(() => 0);
    reloaded.take(read(snapshot(21, { jobs: [job_json('a', ended), kLast] })));
    reloaded.take(read(frame(25, {})));
    expect(drawn(reloaded)).not.toEqual(drawn(watching));  // also keeps what is drawn without the history
    reloaded.take_earlier(kStory.map((text) => read(text) as SequencedMessage));
    expect(drawn(reloaded)).toEqual(drawn(watching));
    expect(reloaded.book.since('b')).toBe(21);
    expect(reloaded.book.changes('a')).toEqual(watching.book.changes('a'));
  });

  it('never shows a paused job as moving, even if the server no longer has its events', () => {
    const reloaded = new Store(() => 0);
    reloaded.take(read(snapshot(21, { jobs: [kLast] })));
    reloaded.take(read(frame(25, {})));
    const [left] = drawn(reloaded).lanes;
    expect(left?.marks.find(({ kind }) => kind === 'pause')).toMatchObject({ job: 'b', from_s: 21, to_s: 25 });
  });
});

describe('Views of one frame', () => {
  beforeEach(() => { vi.useFakeTimers(); });
  afterEach(() => { vi.useRealTimers(); });

  it('show the same job and progress, however late they are drawn', () => {
    let now_ms = 0;
    const store = new Store(() => now_ms);
    store.take(read(snapshot(1)));
    // The list is drawn after changes. Card and row are drawn again with each beat.
    let listed: string | undefined;
    let row = '';
    let card = '';
    const told = (id: string | null | undefined) => {
      const job = id ? store.job(id) : null;
      return job ? `${job.id} ${job.state} ${store.progress(job).toFixed(3)}` : 'nothing';
    };
    const ends = [
      effect(() => { listed = seen(store).jobs('running')[0]?.id; }),
      effect(() => { void store.beats.value; card = told(seen(store).arms.get('left')?.job); row = told(listed); }),
    ];
    const seen_together = new Set<string>();
    const receive = (text: string) => {
      now_ms += 200;  // each pose is a beat
      store.receive(read(text));
      seen_together.add(`${card} | ${row}`);
    };
    const motion = (job: string, progress_s: number) => ({ motions: [{ arm: 'left', job, progress_s, authority_s: 4 }] });
    const running = (id: string) => ({ state: 'running', started_s: 2, duration_s: 4, submitted_s: 1, ...(id === 'b' ? { started_s: 6 } : {}) });
    receive(envelope('job', 2, job_json('a', running('a'))));
    receive(frame(2.1, {}, motion('a', 0)));
    receive(envelope('arm', 3, arm_json('left', { state: 'moving', job: 'a' })));
    vi.advanceTimersByTime(1000);
    receive(frame(4, {}, motion('a', 1.5)));
    expect([card, row]).toEqual(['a running 0.375', 'a running 0.375']);
    // `a` ends and `b` begins. The events arrive one by one; a beat lies between them.
    receive(envelope('job', 6, job_json('a', { ...running('a'), state: 'succeeded', ended_s: 6, progress: 1, result: { reason: 'completed', detail: '' } })));
    receive(frame(6.1, {}, motion('b', 0)));
    expect([card, row]).toEqual(['a running 0.375', 'a running 0.375']);
    receive(envelope('job', 7, job_json('b', running('b'))));
    receive(envelope('arm', 8, arm_json('left', { state: 'moving', job: 'b' })));
    vi.advanceTimersByTime(1000);
    receive(frame(8.2, {}, motion('b', 2)));
    expect([card, row]).toEqual(['b running 0.500', 'b running 0.500']);
    for (const both of seen_together) expect(both.split(' | ')[0]).toBe(both.split(' | ')[1]);
    for (const end of ends) end();
  });

  it('apply waiting messages in order, and before the state of the connection', () => {
    const store = new Store(() => 0);
    store.receive(read(snapshot(1)));
    store.receive(read(frame(3, { left_panda_joint1: 1 })));
    expect(store.stream).toBeNull();
    store.set_link({ status: 'lost', attempt: 1, retry_in_ms: 1 });
    expect([store.stream === null, store.q['left_panda_joint1']]).toEqual([false, 1]);
  });

  it('are not kept waiting without bound', () => {
    const store = new Store(() => 0);
    store.receive(read(snapshot(1)));
    for (let i = 0; i < 2000; i++) store.receive(read(frame(1 + i / 30, {})));
    expect(store.stream).not.toBeNull();
  });
});

describe('Address on the server', () => {
  it('is below the path of the page', () => {
    expect(address_on_server('/api/v1', 'https://plant.example/cells/a/#/job/x')).toBe('https://plant.example/cells/a/api/v1');
    expect(address_on_server('/api/v1', 'http://127.0.0.1:8080/')).toBe('http://127.0.0.1:8080/api/v1');
    expect(address_on_server('login', 'http://127.0.0.1:8080/#/')).toBe('http://127.0.0.1:8080/login');
  });
});
