import { describe, expect, it } from 'vitest';
import type { Camera } from '../src/route/address';
import { kLowest_rad, kNearest_m, step_of_key, stepped, type CameraStep } from '../src/view/steer';

const kFront: Camera = [0, -3, 2, 0, 0, 0.5];

function many(step: CameraStep, count: number): Camera {
  return Array.from({ length: count }).reduce<Camera>((camera) => stepped(camera, step), kFront);
}
const distance = ([x, y, z, at_x, at_y, at_z]: Camera) => Math.hypot(x - at_x, y - at_y, z - at_z);

describe('Camera steps', () => {
  it('go around the target and return after 36 steps', () => {
    expect(stepped(kFront, 'right')[0]).toBeGreaterThan(0.3);
    expect(stepped(kFront, 'left')[0]).toBeLessThan(-0.3);
    many('right', 36).forEach((value, i) => expect(value).toBeCloseTo(kFront[i] ?? NaN, 9));
    expect(distance(stepped(kFront, 'right'))).toBeCloseTo(distance(kFront), 9);
  });
  it('never go below the floor nor over the top', () => {
    const [low, high] = [many('down', 99), many('up', 99)];
    expect(low[2] - 0.5).toBeCloseTo(distance(kFront) * Math.cos(kLowest_rad), 9);
    expect(high[1]).toBeLessThan(0);
  });
  it('come nearer but not through the target', () => {
    expect(distance(stepped(kFront, 'nearer'))).toBeLessThan(distance(kFront));
    expect(distance(many('nearer', 99))).toBeCloseTo(kNearest_m, 9);
    expect(distance(stepped(stepped(kFront, 'nearer'), 'farther'))).toBeCloseTo(distance(kFront), 9);
  });
  it('have a key each, and none of them is a letter', () => {
    expect(['ArrowLeft', 'ArrowUp', '+', '-', '0'].map(step_of_key)).toEqual(['left', 'up', 'nearer', 'farther', 'whole']);
    expect(step_of_key('h')).toBeNull();
  });
});
