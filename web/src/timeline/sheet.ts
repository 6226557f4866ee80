// The geometry of the timeline: times run across, lanes are stacked downward. Lengths are in px.

import { begin_of, type Span } from './span';

export const kLeft_px = 72;
export const kRight_px = 10;
export const kAxis_px = 18;
const kLane_px = 54;

export interface Sheet {
  width: number;
  height: number;
  now_s: number;
  from_s: number;
  length_s: number;
  x(t_s: number): number;
  t_s(x: number): number;
}

export function sheet_of(width: number, height: number, span: Span, now_s: number): Sheet {
  const from_s = begin_of(span, now_s);
  const per_s = Math.max(1, width - kLeft_px - kRight_px) / span.length_s;
  return {
    width, height, now_s, from_s, length_s: span.length_s,
    x: (t_s) => kLeft_px + (t_s - from_s) * per_s,
    t_s: (x) => from_s + (x - kLeft_px) / per_s,
  };
}

/** A horizontal range, px. */
export interface Stretch { from: number; to: number }

/**
 * Returns the widest part of `whole` that no element of `covers` overlaps, or null if all of it is
 * covered.
 */
export function widest_free(whole: Stretch, covers: readonly Stretch[]): Stretch | null {
  const free: Stretch[] = [];
  let from = whole.from;
  for (const cover of [...covers].sort((a, b) => a.from - b.from)) {
    free.push({ from, to: Math.min(cover.from, whole.to) });
    from = Math.max(from, cover.to);
  }
  free.push({ from, to: whole.to });
  const widest = free.reduce((a, b) => (b.to - b.from > a.to - a.from ? b : a));
  return widest.to > widest.from ? widest : null;
}

export function lane_height(sheet: Sheet, lanes: number): number {
  return Math.min(kLane_px, (sheet.height - kAxis_px) / Math.max(1, lanes));
}

export function lane_at(sheet: Sheet, lanes: number, y: number): number {
  return Math.floor(y / lane_height(sheet, lanes));
}

/** Fits the canvas to the size of its element. Returns null if the element has no size. */
export function fit(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
  const { clientWidth: width, clientHeight: height } = canvas;
  const g = canvas.getContext('2d');
  if (!g || width === 0 || height === 0) return null;
  const ratio = Math.min(2, window.devicePixelRatio);
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  return g;
}
