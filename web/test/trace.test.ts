import { describe, expect, it } from 'vitest';
import { Trace } from '../src/state/trace';

describe('the trace of measured joints', () => {
  const filled = (frames: number, capacity = 100) => {
    const trace = new Trace(capacity);
    for (let i = 0; i < frames; i++) trace.push(i, { a: i, b: -i });
    return trace;
  };

  it('answers where every joint was, by the last frame until then', () => {
    const trace = filled(10);
    expect(trace.at(4.7)).toEqual({ a: 4, b: -4 });
    expect(trace.at(9)).toEqual({ a: 9, b: -9 });
    expect(trace.at(9.005)).toEqual({ a: 9, b: -9 });
    expect(trace.at(-0.005)).toEqual({ a: 0, b: -0 });
  });

  it('answers nothing for what was not heard, and says where that lies', () => {
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

  it('keeps so many frames and no more', () => {
    const trace = filled(250);
    expect([trace.first_s, trace.last_s]).toEqual([150, 249]);
    expect(trace.at(149)).toBeNull();
    expect(trace.at(200)).toEqual({ a: 200, b: -200 });
  });

  it('gives curves of a stretch, thinned to what a plot can show', () => {
    const { t_s, q } = filled(100).between(['b'], 10, 20);
    expect(t_s).toEqual([10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20]);
    expect(q[0]?.at(-1)).toBe(-20);
    expect(filled(100).between(['a'], 0, 99, 20).t_s).toHaveLength(20);
    expect(new Trace().between(['a'], 0, 9).t_s).toEqual([]);
  });

  it('begins anew when time goes back or the joints are others', () => {
    const trace = filled(10);
    trace.push(2, { a: 5, b: 5 });
    expect([trace.first_s, trace.last_s]).toEqual([2, 2]);
    trace.push(3, { c: 1 });
    expect(trace.at(3)).toEqual({ c: 1 });
  });
});
