// Colours that mean something, shared by the 3D view, the timeline and the panels.

import type { ArmState, CellState } from './messages';

const kArmColours = ['#56b6f2', '#d59bf6', '#f2a65a', '#7fd67f', '#f28fb0', '#d9d26a'] as const;

export const kStateColours: Record<ArmState, string> = {
  idle: '#6d7a89',
  moving: '#46c793',
  holding: '#f0b541',
  stopped: '#f2565e',
  fault: '#f2565e',
};

/** An arm's own colour, by its place in the cell. */
export function arm_colour(arms: readonly string[], arm: string): string {
  const i = Math.max(0, arms.indexOf(arm));
  return kArmColours[i % kArmColours.length] ?? kArmColours[0];
}

/** Of a coordination diagram's cells. */
export const kCellColours: Record<CellState, string> = {
  free: '#c3cfdb',
  conflict: '#e0454e',
  undecided: '#f0b541',
};
