// Colors with a meaning, defined as custom properties in style/tokens.css for both themes. Elements
// use `var(--…)`; canvases and the 3D view read them with `ink`.

import type { CellState } from '../server/messages';
import type { ShownState } from './shown_state';

const kArmColors = 8;

export const kStateColors: Record<ShownState, string> = {
  idle: 'var(--idle)',
  moving: 'var(--moving)',
  paused: 'var(--paused)',
  waiting: 'var(--paused)',
  stopped: 'var(--alarm)',
  fault: 'var(--alarm)',
  'not known': 'var(--dim)',
};

/** Glyphs, because color alone must not carry a state. */
export const kStateGlyphs: Record<ShownState, string> = {
  idle: '○', moving: '▶', paused: '❚❚', waiting: '◔', stopped: '■', fault: '✕', 'not known': '?',
};

/** Returns the arm's color, by its position in the cell. */
export function arm_color(arms: readonly string[], arm: string): string {
  return `var(--arm-${Math.max(0, arms.indexOf(arm)) % kArmColors})`;
}

/** The cells of a diagram, in both themes. */
export const kCellColors: Record<CellState, string> = {
  free: '#c3cfdb',
  conflict: '#e0454e',
  undecided: '#f0b541',
};
/** Undecided cells are hatched, to be recognized without colors. */
export const kUndecidedStripes = '#6e4c00';

const known = new Map<string, string>();

/** Returns the theme's value of `var(--name)` or `--name`; other colors unchanged. */
export function ink(color: string): string {
  const name = /--[\w-]+/.exec(color)?.[0];
  if (name === undefined) return color;
  let found = known.get(name);
  if (found === undefined) {
    found = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    known.set(name, found);
  }
  return found;
}

/** Clears the cache after a change of theme. */
export function forget_inks(): void {
  known.clear();
}
