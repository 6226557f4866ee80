// Moves the camera in steps, for users who cannot drag: around the target, nearer and farther.
// Pure.

import type { Camera } from '../route/address';

/** `whole` returns to the default view, which shows the whole cell. */
export type CameraStep = 'left' | 'right' | 'up' | 'down' | 'nearer' | 'farther' | 'whole';

const kTurn_rad = Math.PI / 18;
const kTilt_rad = Math.PI / 24;
const kCloser = 1.2;
export const kNearest_m = 0.5;
/**
 * Limits of the camera's polar angle: not below the floor, and not exactly from above. Exactly
 * above the target, left and right would be undefined.
 */
export const kLowest_rad = Math.PI / 2 - 0.03;
const kHighest_rad = 0.08;

const kKeys: ReadonlyMap<string, CameraStep> = new Map([
  ['ArrowLeft', 'left'], ['ArrowRight', 'right'], ['ArrowUp', 'up'], ['ArrowDown', 'down'],
  ['+', 'nearer'], ['=', 'nearer'], ['-', 'farther'], ['−', 'farther'], ['0', 'whole'],
]);

export function step_of_key(key: string): CameraStep | null {
  return kKeys.get(key) ?? null;
}

/** Returns the camera after a step. `left` means that the camera itself moves to the left. */
export function stepped([x, y, z, at_x, at_y, at_z]: Camera, step: CameraStep): Camera {
  const [dx, dy, dz] = [x - at_x, y - at_y, z - at_z];
  const across = Math.hypot(dx, dy);
  const scale = step === 'nearer' ? 1 / kCloser : step === 'farther' ? kCloser : 1;
  const distance = Math.max(kNearest_m, scale * Math.hypot(across, dz));
  const turned = Math.atan2(dy, dx) + (step === 'right' ? kTurn_rad : step === 'left' ? -kTurn_rad : 0);
  const tilt = Math.atan2(across, dz) + (step === 'down' ? kTilt_rad : step === 'up' ? -kTilt_rad : 0);
  const polar = Math.min(kLowest_rad, Math.max(kHighest_rad, tilt));
  const radius = distance * Math.sin(polar);
  return [at_x + radius * Math.cos(turned), at_y + radius * Math.sin(turned), at_z + distance * Math.cos(polar), at_x, at_y, at_z];
}

/**
 * Returns true if the cameras are equal within the precision of addresses, which is a millimeter.
 */
export function is_same(a: Camera, b: Camera): boolean {
  return a.every((value, i) => Math.abs(value - (b[i] ?? 0)) < 2e-3);
}
