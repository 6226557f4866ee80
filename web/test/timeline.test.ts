import { describe, expect, it } from 'vitest';
import type { Forecast, Job } from '../src/server/messages';
import { drawn_of, lanes_of, mark_at, pasts_of, type Lane } from '../src/timeline/lanes';
import { sheet_of, widest_free } from '../src/timeline/sheet';
import { around, begin_of, kFollowing, kNowAt, moved, tick_of, zoomed } from '../src/timeline/span';
import { lane_in_words } from '../src/timeline/mark_words';
import { job_json, step_json, wait_json } from './samples';

const job = (id: string, over: object) => job_json(id, over) as unknown as Job;

const kForecast = {
  now_s: 10, horizon_steps: 6,
  arms: [{
    name: 'left', waiting: 2, steps: [
      { id: 'now', name: 'now', arms: ['left'], state: 'running', progress: 0.5, starts_s: 8, ends_s: 12, pauses: [] },
      {
        id: 'next', name: 'place', arms: ['left'], state: 'scheduled', progress: 0, starts_s: 13, ends_s: 20, pauses: [
          { from_s: 12, to_s: 13, at_s: 0, waits_on: wait_json() },
          { from_s: 15, to_s: 16.5, at_s: 2, waits_on: wait_json() },
        ],
      },
      { id: 'stuck', name: '', arms: ['left'], state: 'scheduled', progress: 0, starts_s: null, ends_s: null, pauses: [{ from_s: 20, to_s: null, at_s: 0, waits_on: null }] },
    ],
  }],
} as unknown as Forecast;

const kNoHistory = { pauses: () => [], steps: () => [] };
const known = (jobs: Job[], forecast: Forecast | null, now_s = 10): Lane =>
  lanes_of({
    arms: ['left'], jobs: jobs.filter((one) => one.ended_s === null), pasts: pasts_of(['left'], jobs.filter((one) => one.ended_s !== null), kNoHistory),
    ...kNoHistory, has_ended: (id) => jobs.some((one) => one.id === id && one.ended_s !== null), forecast, now_s,
  })[0] as Lane;

describe('Timeline lanes', () => {
  it('show past motions, and waits only while the arm could have moved', () => {
    const lane = known([
      job('a', { state: 'succeeded', submitted_s: 1, started_s: 1, ended_s: 4 }),
      job('b', { state: 'succeeded', submitted_s: 1, started_s: 6, ended_s: 7 }),
      job('c', { state: 'running', submitted_s: 1, started_s: 7, ended_s: null }),
      job('d', { state: 'queued', submitted_s: 1 }),
    ], null);
    expect(lane.marks.map(({ kind, job, from_s, to_s }) => [kind, job, from_s, to_s])).toEqual([
      ['motion', 'a', 1, 4], ['wait', 'b', 4, 6], ['motion', 'b', 6, 7], ['motion', 'c', 7, 10],
    ]);
  });

  it('show predicted motions, pauses and waits with their blockers', () => {
    const lane = known([job('now', { state: 'running', submitted_s: 8, started_s: 8 })], kForecast);
    const expected = lane.marks.filter((mark) => mark.expected);
    expect(expected.map(({ kind, job, from_s, to_s }) => [kind, job, from_s, to_s])).toEqual([
      ['motion', 'now', 10, 12], ['motion', 'next', 13, 20], ['wait', 'next', 12, 13], ['pause', 'next', 15, 16.5],
      ['wait', 'stuck', 20, Infinity],
    ]);
    expect(mark_at(lane, 15.5)?.waits_on?.arm).toBe('right');
    expect(mark_at(lane, 14)?.kind).toBe('motion');
    expect(mark_at(lane, 12.5)?.kind).toBe('wait');
  });

  it('omit what an event has ended since the prediction', () => {
    const lane = known([job('now', { state: 'succeeded', submitted_s: 8, started_s: 8, ended_s: 9.9 })], kForecast);
    expect(lane.marks.some((mark) => mark.expected && mark.job === 'now')).toBe(false);
  });

  it('have a motion for each step that moves the arm, with the time before the first known step as one', () => {
    const steps = [['above', ['left']], ['', []], ['lift', ['left']], ['other', ['right']], ['back', ['left']]]
      .map(([name, arms]) => step_json(name === '' ? 'wait_s' : 'move_to', { name, arms, detail: name === '' ? '1 s' : '' }));
    const begun = [{ step: 1, t_s: 3 }, { step: 2, t_s: 4 }, { step: 3, t_s: 6 }, { step: 4, t_s: 7 }];
    const motions = (over: object) => {
      const stepped = job('pick', { arms: ['left', 'right'], submitted_s: 1, started_s: 1, steps, ...over });
      const history = { pauses: () => [], steps: () => begun };
      const ended = stepped.ended_s !== null;
      const [left, right] = lanes_of({
        arms: ['left', 'right'], jobs: ended ? [] : [stepped], pasts: pasts_of(['left', 'right'], ended ? [stepped] : [], history), ...history, has_ended: () => ended, forecast: null, now_s: 10,
      });
      return [left, right].map((lane) => lane?.marks.map(({ label, from_s, to_s, state }) => [label, from_s, to_s, state]));
    };
    expect(motions({ state: 'running', step: 4 })).toEqual([
      [['', 1, 3, 'running'], ['pick: lift', 4, 6, 'succeeded'], ['pick: back', 7, 10, 'running']],
      [['', 1, 3, 'running'], ['pick: other', 6, 7, 'succeeded']],
    ]);
    expect(motions({ state: 'failed', ended_s: 9, name: 'Pick 7', result: { reason: 'no_plan', detail: '', step: 4 } })[0]).toEqual([
      ['Pick 7', 1, 3, 'failed'], ['Pick 7: lift', 4, 6, 'succeeded'], ['Pick 7: back', 7, 9, 'failed'],
    ]);
    begun.push({ step: 1, t_s: 9 });
    expect(motions({ state: 'failed', ended_s: 9, result: { reason: 'step_failed', detail: '', step: 1 } })[0]?.at(-1), 'an action after the motion failed').toEqual(['pick: back', 7, 9, 'failed']);
    expect(motions({ state: 'paused', step: 1 })[0]?.at(-1), 'an action is under way').toEqual(['pick: back', 7, 9, 'succeeded']);
  });

  it('tell of a job with steps that it has begun, although the server predicts no more of it', () => {
    const steps = [step_json('move_to', { arms: ['left'] }), step_json('wait_s', { detail: '1 s' })];
    const forecast = (waiting: number, listed: object[] = []) => ({ now_s: 10, horizon_steps: 6, arms: [{ name: 'left', waiting, steps: listed }] }) as unknown as Forecast;
    const words = (over: object, expected: Forecast) => lane_in_words(known([job('pick', { state: 'paused', started_s: 2, steps, step: 1, ...over })], expected), 10);
    expect(words({}, forecast(1))).toEqual(['pick: step 2 of 2 (wait 1 s), end not predicted']);
    expect(words({}, forecast(3))).toEqual(['pick: step 2 of 2 (wait 1 s), end not predicted', '2 more jobs not scheduled yet']);
    const [first] = kForecast.arms[0]?.steps ?? [];
    expect(words({ state: 'running', step: 0 }, forecast(1, [{ ...first, id: 'pick', name: '' }]))).toEqual(['pick: running, 0:00:10.0 to 0:00:12.0', '1 more job not scheduled yet']);
    expect(words({ state: 'queued', started_s: null, step: 0 }, forecast(1))).toEqual(['1 more job not scheduled yet']);
  });

  it('are described soonest first, jobs without times last', () => {
    const words = lane_in_words(known([], kForecast), 10);
    expect(words[0]).toMatch(/^now: running, 0:00:10.0 to 0:00:12.0/);
    expect(words[1]).toMatch(/^place waits for job place-6 of right: .* until 0:00:13.0 \(1.0 s\)/);
    expect(words.at(-1)).toBe('2 more jobs not scheduled yet');
    expect(lane_in_words(known([], null), 10)).toEqual(['nothing is planned']);
  });
});

describe('Timeline span', () => {
  it('follows now until it is fixed', () => {
    expect(begin_of(kFollowing, 100)).toBeCloseTo(100 - kNowAt * kFollowing.length_s);
    const held = moved(kFollowing, -5, 100);
    expect(begin_of(held, 100)).toBeCloseTo(begin_of(kFollowing, 100) - 5);
    expect(begin_of(held, 107)).toBe(begin_of(held, 100));
  });

  it('zooms about the pointed time, within limits', () => {
    const held = around({ length_s: 40, fixed_from_s: null }, 60);
    expect(held.fixed_from_s).toBe(40);
    const near = zoomed(held, 0.5, 100, 0.25);
    expect(near).toEqual({ length_s: 20, fixed_from_s: 45 });
    expect(zoomed(held, 1e9, 100).length_s).toBe(3600);
    expect(zoomed(kFollowing, 1e-9, 100)).toEqual({ length_s: 4, fixed_from_s: null });
  });

  it('shows any time, also while the current time is unknown', () => {
    const opened = around(kFollowing, 873.92);
    const sheet = sheet_of(1000, 100, opened, 0);
    expect((sheet.x(873.92) - sheet.x(opened.fixed_from_s ?? 0)) / (sheet.x(923.92) - sheet.x(873.92))).toBeCloseTo(0.5);
    expect(around(kFollowing, 0).fixed_from_s).toBe(-25);
  });

  it('never goes beyond what can be known', () => {
    expect(moved(kFollowing, 1e6, 100).fixed_from_s).toBeLessThan(800);
    expect(moved(kFollowing, -1e6, 100).fixed_from_s).toBeGreaterThan(-60);
  });

  it('has round ticks', () => {
    expect(tick_of(60, 8)).toBe(10);
    expect(tick_of(600, 8)).toBe(120);
    expect(tick_of(4, 8)).toBe(0.5);
  });
});

describe('Drawn marks of a lane', () => {
  const many = Array.from({ length: 10_000 }, (_, i) =>
    job(`j${i}`, { state: i % 1000 === 500 ? 'failed' : 'succeeded', submitted_s: 0.3 * i, started_s: 0.3 * i, ended_s: 0.3 * i + 0.2 }));
  const { marks } = known(many, null, 3000);
  it('are at most one per pixel, but include all failures', () => {
    expect(marks.length).toBeGreaterThanOrEqual(10_000);
    const drawn = drawn_of(marks, 0, 3000, 3);
    expect(drawn.length).toBeLessThan(1100);
    expect(drawn.filter(({ state }) => state === 'failed')).toHaveLength(10);
    // Every pixel with a motion shows a mark.
    for (let s = 0; s < 2990; s += 3) expect(drawn.some(({ from_s }) => from_s >= s - 3 && from_s < s + 3)).toBe(true);
  });
  it('are all if there is room, and none outside of the range', () => {
    const drawn = drawn_of(marks, 300, 330, 0.05);
    expect(drawn.length).toBe(marks.filter(({ from_s, to_s }) => to_s >= 300 && from_s <= 330).length);
  });
});

describe('Visible part of a bar', () => {
  const bar = { from: 100, to: 200 };

  it('is the whole bar if nothing covers it', () => {
    expect(widest_free(bar, [])).toEqual(bar);
    expect(widest_free(bar, [{ from: 0, to: 100 }, { from: 200, to: 300 }])).toEqual(bar);
  });

  it('is after a stop at its begin, or before a stop at its end', () => {
    expect(widest_free(bar, [{ from: 90, to: 130 }])).toEqual({ from: 130, to: 200 });
    expect(widest_free(bar, [{ from: 160, to: Infinity }])).toEqual({ from: 100, to: 160 });
  });

  it('is the widest between several, in any order and overlap', () => {
    const covers = [{ from: 180, to: 190 }, { from: 110, to: 120 }, { from: 105, to: 140 }, { from: 112, to: 115 }];
    expect(widest_free(bar, covers)).toEqual({ from: 140, to: 180 });
  });

  it('is null if all is covered', () => {
    expect(widest_free(bar, [{ from: 50, to: 150 }, { from: 140, to: 250 }])).toBeNull();
    expect(widest_free({ from: 100, to: 100 }, [])).toBeNull();
  });
});
