import { describe, expect, it } from 'vitest';
import { kFirstInSoftware, kLevels, Pace } from '../src/view/pace';

function after(...took_ms: number[]): Pace {
  const pace = new Pace();
  for (const ms of took_ms) pace.took(ms);
  return pace;
}
const times = (count: number, ms: number) => Array<number>(count).fill(ms);

describe('Pace of the 3D view', () => {
  it('is 30 full frames per second while drawing is quick, 60 if it is very cheap', () => {
    const pace = after(...times(100, 12));
    expect(pace.level).toEqual({ resolution: 1, fine: true, ghosts: true });
    expect(1000 / pace.took(12)).toBeGreaterThan(33);
    expect(1000 / pace.took(26)).toBeGreaterThan(33);
    expect(1000 / pace.took(3)).toBeGreaterThan(60);
  });
  it('leaves the page more time the longer drawing takes', () => {
    expect(new Pace().took(30)).toBeCloseTo(30);
    expect(new Pace().took(60)).toBeCloseTo(120);
    expect(new Pace().took(300)).toBeCloseTo(1200);
  });
  it('says when drawing should wait for the page', () => {
    expect(new Pace().disturbs).toBe(false);
    expect(after(60).disturbs).toBe(true);
    expect(after(60, 20).disturbs).toBe(false);
  });
  it('does not change after one slow frame', () => {
    expect(after(500, 20, 500, 20).level).toBe(kLevels[0]);
  });
  it('leaves a level that does not reach 30 frames per second', () => {
    expect(after(...times(9, 40)).level).toBe(kLevels[0]);
    expect(after(...times(10, 40)).level).toEqual({ resolution: 1, fine: false, ghosts: true });
    expect(after(...times(20, 40)).level).toEqual({ resolution: 1, fine: false, ghosts: false });
  });
  it('keeps full resolution while frames are only slightly slow', () => {
    expect(after(...times(500, 40)).level.resolution).toBe(1);
    expect(after(...times(500, 100)).level.resolution).toBe(0.6);
  });
  it('has a last level and a longest pause', () => {
    const pace = after(...times(50, 5_000));
    expect(pace.level).toBe(kLevels.at(-1));
    expect(pace.took(5_000)).toBe(7_000);
  });
  it('rises one level at a time after a quick phase', () => {
    const pace = after(...times(4, 300), ...times(89, 5));
    expect(pace.level).toBe(kLevels[2]);
    pace.took(5);
    expect(pace.level).toBe(kLevels[1]);
    for (const ms of times(90, 5)) pace.took(ms);
    expect(pace.level).toBe(kLevels[0]);
  });
  it('rises from the last level once the machine is idle', () => {
    const pace = after(...times(20, 2_000), ...times(1_000, 8));
    expect(pace.level).toBe(kLevels[0]);
  });
  it('retries a failed level less and less often', () => {
    const pace = new Pace(kFirstInSoftware);
    // As with software rendering: fine frames are slow, all others are quick.
    let fine = 0;
    for (let i = 0; i < 20_000; i++) {
      if (pace.level.fine) fine += 1;
      pace.took(pace.level.fine ? 150 : 10);
    }
    expect(fine).toBeGreaterThan(0);
    expect(fine).toBeLessThan(60);
  });
});
