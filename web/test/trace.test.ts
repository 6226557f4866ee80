import { describe, expect, it } from 'vitest';
import { Trace } from '../src/state/trace';

describe('Trace', () => {
  const filled = (frames: number, capacity = 100) => {
    const trace = new Trace(capacity);
    for (let i = 0; i < frames; i++) trace.push(i, { a: i, b: -i });
    return trace;
  };

  it('returns all joints at the last frame up to a time', () => {
    const trace = filled(10);
    expect(trace.at(4.7)).toEqual({ a: 4, b: -4 });
    expect(trace.at(9)).toEqual({ a: 9, b: -9 });
    expect(trace.at(9.005)).toEqual({ a: 9, b: -9 });
    expect(trace.at(-0.005)).toEqual({ a: 0, b: -0 });
  });

  it('returns null without data, and says where the time lies', () => {
    expect(new Trace().heard(3)).toBe('nothing');
    const trace = filled(10);
    expect([trace.heard(-1), trace.at(-1)]).toEqual(['before', null]);
    expect([trace.heard(99), trace.at(99)]).toEqual(['after', null]);
    expect(trace.heard(4.7)).toBe('kept');
    trace.break_off();
    trace.push(20, { a: 20, b: -20 });
    trace.push(21, { a: 21, b: -21 });
    expect([trace.heard(9.5), trace.at(15)]).toEqual(['gap', null]);
    expect([trace.at(9), trace.at(20), trace.at(20.5)]).toEqual([{ a: 9, b: -9 }, { a: 20, b: -20 }, { a: 20, b: -20 }]);
    expect(trace.at(19.995)).toEqual({ a: 20, b: -20 });
  });

  it('keeps a fixed number of frames', () => {
    const trace = filled(250);
    expect([trace.first_s, trace.last_s]).toEqual([150, 249]);
    expect(trace.at(149)).toBeNull();
    expect(trace.at(200)).toEqual({ a: 200, b: -200 });
  });

  it('returns curves of a stretch, thinned for a plot', () => {
    const { t_s, q } = filled(100).between(['b'], 10, 20);
    expect(t_s).toEqual([10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20]);
    expect(q[0]?.at(-1)).toBe(-20);
    expect(filled(100).between(['a'], 0, 99, 20).t_s).toHaveLength(20);
    expect(new Trace().between(['a'], 0, 9).t_s).toEqual([]);
  });

  it('restarts when time goes back or the joints change', () => {
    const trace = filled(10);
    trace.push(2, { a: 5, b: 5 });
    expect([trace.first_s, trace.last_s]).toEqual([2, 2]);
    trace.push(3, { c: 1 });
    expect(trace.at(3)).toEqual({ c: 1 });
  });

  describe('Trace filled with earlier data', () => {
    const steps = (from: number, to: number) => Array.from({ length: to - from + 1 }, (_, i) => from + i);
    const fill = (trace: Trace, t_s: number[], names = ['b', 'a']) => trace.fill(names, t_s, t_s.map((at) => names.map((name) => (name === 'a' ? 100 + at : -100 - at))));

    it('begins with the earlier data and keeps its own', () => {
      const trace = new Trace(100);
      for (const t of [50, 50.5, 51]) trace.push(t, { a: t, b: -t });
      fill(trace, steps(40, 60));
      expect([trace.first_s, trace.last_s]).toEqual([40, 51]);
      expect([trace.at(45.2), trace.at(49), trace.at(50.6)]).toEqual([{ a: 145, b: -145 }, { a: 149, b: -149 }, { a: 50.5, b: -50.5 }]);
      expect(trace.heard(49.7)).toBe('kept');
      trace.push(52, { a: 52, b: -52 });
      expect(trace.at(52)).toEqual({ a: 52, b: -52 });
    });

    it('has only the earlier data if it had none', () => {
      const trace = new Trace(100);
      fill(trace, steps(1, 5));
      expect([trace.names, trace.first_s, trace.last_s, trace.at(3)]).toEqual([['b', 'a'], 1, 5, { a: 103, b: -103 }]);
    });

    it('fills its gaps, and leaves gaps without data', () => {
      const trace = new Trace(100);
      for (const t of [10, 11]) trace.push(t, { a: t, b: -t });
      trace.break_off();
      for (const t of [20, 21]) trace.push(t, { a: t, b: -t });
      fill(trace, steps(10, 21));
      expect(steps(10, 21).map((t) => trace.heard(t + 0.5))).toEqual([...Array.from({ length: 11 }, () => 'kept'), 'after']);
      expect([trace.at(11), trace.at(15.5), trace.at(20)]).toEqual([{ a: 11, b: -11 }, { a: 115, b: -115 }, { a: 20, b: -20 }]);
      trace.break_off();
      trace.push(40, { a: 40, b: -40 });
      fill(trace, steps(20, 24));
      expect([22.5, 24, 26, 39, 40].map((t) => trace.heard(t))).toEqual(['kept', 'kept', 'gap', 'gap', 'kept']);
    });

    it('ignores data of other joints, and stays within its capacity', () => {
      const trace = new Trace(10);
      for (const t of [50, 51]) trace.push(t, { a: t, b: -t });
      fill(trace, steps(40, 49), ['a']);
      expect(trace.first_s).toBe(50);
      fill(trace, steps(0, 49));
      expect([trace.first_s, trace.last_s]).toEqual([42, 51]);
    });
  });
});
