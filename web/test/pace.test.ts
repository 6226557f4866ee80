import { describe, expect, it } from 'vitest';
import { kLevels, Pace } from '../src/view/pace';

function after(...took_ms: number[]): Pace {
  const pace = new Pace();
  for (const ms of took_ms) pace.took(ms);
  return pace;
}
const times = (count: number, ms: number) => Array<number>(count).fill(ms);

describe('the pace of the 3D view', () => {
  it('is thirty whole pictures a second while they are quick', () => {
    const pace = after(...times(100, 5));
    expect(pace.level).toEqual({ resolution: 1, shadows: true, ghosts: true });
    expect(pace.took(5)).toBeCloseTo(1000 / 31 - 1);
  });
  it('leaves half of the time to the page', () => {
    expect(new Pace().took(80)).toBe(160);
  });
  it('does not change for one that took long', () => {
    expect(after(500, 20, 500, 20).level).toBe(kLevels[0]);
  });
  it('leaves out shadows, then points, and rests longer, while they take long', () => {
    const pace = after(300, 300);
    expect(pace.level).toEqual({ resolution: 1, shadows: false, ghosts: true });
    pace.took(300);
    pace.took(300);
    expect(pace.level.resolution).toBeLessThan(1);
    expect(pace.took(300)).toBe(1200);
  });
  it('has a last level, and a longest pause', () => {
    const pace = after(...times(50, 5_000));
    expect(pace.level).toBe(kLevels.at(-1));
    expect(pace.took(5_000)).toBe(7_000);
  });
  it('comes back when they have been quick for a while, a level at a time', () => {
    const pace = after(...times(4, 300), ...times(89, 5));
    expect(pace.level).toBe(kLevels[2]);
    pace.took(5);
    expect(pace.level).toBe(kLevels[1]);
    for (const ms of times(90, 5)) pace.took(ms);
    expect(pace.level).toBe(kLevels[0]);
  });
});
