// Colors that have a meaning. They are custom properties in style/tokens.css, one set for each
// theme. Elements use `var(--…)`. Canvases and the 3D view read them with `ink`.

import type { CellState, Step } from '../server/messages';
import type { ShownState } from './shown_state';

const kArmColors = 8;

export const kStateColors: Record<ShownState, string> = {
  idle: 'var(--idle)',
  moving: 'var(--moving)',
  paused: 'var(--paused)',
  waiting: 'var(--paused)',
  stopped: 'var(--alarm)',
  fault: 'var(--alarm)',
  'link lost': 'var(--alarm)',
  connecting: 'var(--paused)',
  'not known': 'var(--dim)',
};

/** A glyph for each state, because states must be recognized without colors. */
export const kStateGlyphs: Record<ShownState, string> = {
  idle: '○', moving: '▶', paused: '❚❚', waiting: '◔', stopped: '■', fault: '✕', 'link lost': '⊘', connecting: '…', 'not known': '?',
};

/** A glyph for the state of each step of a job. */
export const kStepGlyphs: Record<Step['state'], string> = { waiting: '○', running: '▶', done: '✓', failed: '✕' };

/** Returns the color of an arm. It depends on the place of the arm in the cell's list. */
export function arm_color(arms: readonly string[], arm: string): string {
  return `var(--arm-${Math.max(0, arms.indexOf(arm)) % kArmColors})`;
}

/** The fill colors of a diagram's cells. They are the same in both themes. */
export const kCellColors: Record<CellState, string> = {
  free: '#c3cfdb',
  conflict: '#e0454e',
  undecided: '#f0b541',
};
/** The color of the hatching on undecided cells, which are recognized by it without colors. */
export const kUndecidedStripes = '#6e4c00';

const known = new Map<string, string>();

/**
 * Returns the present theme's value of `var(--name)` or `--name`. Other colors are returned
 * unchanged.
 */
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

/** Clears the cache of colors. Must be called after a change of the theme. */
export function forget_inks(): void {
  known.clear();
}
