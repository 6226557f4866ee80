// Colours that mean something. They are defined once, as custom properties in style/tokens.css, for
// both themes: elements use them as `var(--…)`, canvases and the 3D view ask `ink` for what stands there
// now.

import type { CellState } from '../server/messages';
import type { ShownState } from './shown_state';

const kArmColours = 8;

export const kStateColours: Record<ShownState, string> = {
  idle: 'var(--idle)',
  moving: 'var(--moving)',
  paused: 'var(--paused)',
  waiting: 'var(--paused)',
  stopped: 'var(--alarm)',
  fault: 'var(--alarm)',
  'not known': 'var(--dim)',
};

/** A state is never told by colour alone. */
export const kStateGlyphs: Record<ShownState, string> = {
  idle: '○', moving: '▶', paused: '❚❚', waiting: '◔', stopped: '■', fault: '✕', 'not known': '?',
};

/** An arm's own colour, by its place in the cell. */
export function arm_colour(arms: readonly string[], arm: string): string {
  return `var(--arm-${Math.max(0, arms.indexOf(arm)) % kArmColours})`;
}

/** Of a coordination diagram's cells, in both themes. */
export const kCellColours: Record<CellState, string> = {
  free: '#c3cfdb',
  conflict: '#e0454e',
  undecided: '#f0b541',
};
/** What is undecided is hatched, too: it is told from what is free where colours are not. */
export const kUndecidedStripes = '#6e4c00';

const known = new Map<string, string>();

/** `var(--name)` or `--name` as the theme has it now; any other colour as it is. */
export function ink(colour: string): string {
  const name = /--[\w-]+/.exec(colour)?.[0];
  if (name === undefined) return colour;
  let found = known.get(name);
  if (found === undefined) {
    found = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    known.set(name, found);
  }
  return found;
}

/** Another theme: what was read before no longer holds. */
export function forget_inks(): void {
  known.clear();
}
