import { describe, expect, it } from 'vitest';
import { EventsReader } from '../src/recordings/read_events';
import { StatesReader } from '../src/recordings/read_states';
import { instant_of, pose_at } from '../src/state/instant';
import { Store } from '../src/state/store';
import { arm_json, envelope, job_json, snapshot } from './samples';

function read(...parts: string[]) {
  const reader = new StatesReader();
  for (const part of parts) reader.take(part);
  return reader.end();
}

function events_in(...parts: string[]) {
  const reader = new EventsReader();
  for (const part of parts) reader.take(part);
  return reader.end();
}

describe('states.csv', () => {
  it('is read in parts split anywhere, at thirty rows per second', () => {
    const rows = Array.from({ length: 1001 }, (_, i) => `${(i / 1000).toFixed(3)},${i},-1`);
    const text = ['time_s,a,b', ...rows].join('\n');
    const read_back = read(text.slice(0, 17), text.slice(17, 100), text.slice(100));
    expect(read_back.ok && read_back.frames.names).toEqual(['a', 'b']);
    const frames = read_back.ok ? read_back.frames : { t_s: [], q: [] };
    expect(frames.t_s.length).toBe(30);
    expect(frames.q.every(([a], i) => a === Math.round((frames.t_s[i] ?? 0) * 1000))).toBe(true);
  });

  it('is refused with the place and content of a fault', () => {
    expect(read('hello\n')).toEqual({ ok: false, fault: expect.stringMatching(/line 1.*hello/) });
    expect(read('time_s,a\n0,1\n1,two\n')).toEqual({ ok: false, fault: expect.stringMatching(/line 3.*1,two/) });
    expect(read('time_s,a\n', '7'.repeat(1 << 20), '7')).toEqual({ ok: false, fault: expect.stringMatching(/line 2 has no end within 1 MiB/) });
    expect(read('time_s,a\n')).toEqual({ ok: false, fault: expect.stringMatching(/no row/) });
  });

  it('is read without an incomplete last row', () => {
    const back = read('time_s,a\n0,1\n1,2\n2,2.7', '182');
    expect(back.ok && back.frames.t_s).toEqual([0, 1]);
  });

  it('is thinned further if it is long', () => {
    const reader = new StatesReader();
    reader.take('time_s,a\n');
    for (let i = 0; i < 100_000; i++) reader.take(`${i},0\n`);
    const back = reader.end();
    expect(back.ok && back.frames.t_s.length).toBeLessThan(60_000);
    expect(back.ok && back.frames.t_s[0]).toBe(0);
  });
});

describe('events.jsonl', () => {
  it('is read with and without wall times; unreadable lines are counted', () => {
    const bare = JSON.parse(envelope('job', 2, job_json('a'))) as { at?: string; data: Record<string, unknown> };
    delete bare.at;
    for (const key of ['submitted_at', 'scheduled_at', 'started_at', 'ended_at']) delete bare.data[key];
    const text = [envelope('arm', 1, arm_json('left')), JSON.stringify(bare), '{"type": "new", "at": ""}', 'no JSON'].join('\n');
    const events = events_in(text.slice(0, 40), text.slice(40, 700), text.slice(700));
    expect(events.messages.map(({ type }) => type)).toEqual(['arm', 'job']);
    expect(events.unread).toBe(2);
  });
});

describe('Store with a recording', () => {
  it('has its jobs, positions and end, and forgets them afterwards', () => {
    const store = new Store(() => 0);
    const first = events_in(snapshot(1)).messages;
    for (const message of first) store.take(message);
    const { messages } = events_in(envelope('job', 5, job_json('old', { state: 'succeeded', started_s: 2, ended_s: 4 }), { stream: 'another', t_s: 4 }));
    store.show_recording('run', messages, { names: ['left_panda_joint1'], t_s: [1, 2, 3], q: [[0], [0.1], [0.2]] });
    expect(store.link).toEqual({ status: 'recording', name: 'run' });
    expect(store.jobs('finished').map(({ id }) => id)).toEqual(['old']);
    expect(store.trace.at(2.5)).toEqual({ left_panda_joint1: expect.closeTo(0.1) });
    expect([...store.arms.keys()]).toEqual(['left', 'right']);
    expect(store.t_s).toBe(4);
    expect(store.notices).toEqual([]);
    expect(store.span).toEqual({ first_s: 1, last_s: 3 });
    store.forget_all();
    for (const message of first) store.take(message);
    expect(store.all_jobs()).toEqual([]);
    expect(store.notices).toEqual([]);
  });

  it('without positions follows events, and shows no live positions', () => {
    const store = new Store(() => 0);
    for (const message of events_in(snapshot(1)).messages) store.take(message);
    expect(store.span).toBeNull();
    const { messages } = events_in([2, 7].map((seq) => envelope('arm', seq, arm_json('left', { state: 'moving' }), { stream: 'another' })).join('\n'));
    store.show_recording('run', messages, null);
    expect(store.span).toEqual({ first_s: 2, last_s: 7 });
    expect(store.q).toEqual({});
    expect(pose_at(instant_of({ t_s: 3, run: null }, store), store)).toBeNull();
    expect(pose_at(instant_of({ t_s: null, run: null }, store), store)).toBeNull();
  });
});
