// Draws the timeline on a canvas: axis, lanes, marks, and lines from waits to their blockers.

import type { Pause } from '../state/job_book';
import { arm_color, ink } from '../state/palette';
import { short_id } from '../wording';
import { draw_events, type EventMark } from './events';
import { drawn_of, type Lane, type Mark } from './lanes';
import { kAxis_px, kLeft_px, kRight_px, lane_height, widest_free, type Sheet, type Stretch } from './sheet';
import { tick_of } from './span';
import { characters_of, shown_name } from '../names';
import { kText } from '../strings';

/**
 * The highlighted parts. If jobs or arms are selected, all others are dimmed. `shown_s` is the shown
 * time if it is a past time, else null.
 */
export interface Lit {
  jobs: readonly string[];
  arms: readonly string[];
  shown_s: number | null;
  /** True if the data is old. The line then marks the time of the last data, not now. */
  stale: boolean;
  events: readonly EventMark[];
  /** The periods in which arms were stopped. */
  halts: ReadonlyMap<string, readonly Pick<Pause, 'from_s' | 'to_s'>[]>;
}
/** The marks under the pointer, or chosen by keys. */
export interface Pointed { mark: Mark | null; events: readonly EventMark[] }

const kFont = '"Inter Variable", system-ui, sans-serif';
const kHatch_px = 5;
// The least width of a bar, px.
const kLeast_px = 2;

/**
 * The geometry of one arm's lane, px. `covers` are the places where a bar is hidden: under pauses
 * and stops, and outside of the timeline.
 */
interface Row { top: number; height: number; color: string; bar_top: number; bar_height: number; wait_top: number; wait_height: number; covers: readonly Stretch[] }

export function paint(g: CanvasRenderingContext2D, sheet: Sheet, lanes: readonly Lane[], lit: Lit, pointed: Pointed): void {
  const { mark: hover } = pointed;
  g.clearRect(0, 0, sheet.width, sheet.height);
  const arms = lanes.map((lane) => lane.arm);
  const drawn = lanes.map(({ marks }) => drawn_of(marks, sheet.from_s, sheet.from_s + sheet.length_s, sheet.t_s(kLeast_px) - sheet.t_s(0)));
  const rows = lanes.map(({ arm }, i) => row_of(sheet, arms, arm, i, [...lit.halts.get(arm) ?? [], ...(drawn[i] ?? []).filter(({ kind }) => kind === 'pause')]));
  draw_axis(g, sheet);
  g.save();
  g.beginPath();
  g.rect(kLeft_px, 0, sheet.width - kLeft_px - kRight_px, sheet.height);
  g.clip();
  lanes.forEach((lane, i) => {
    const row = rows[i];
    if (!row) return;
    for (const halt of lit.halts.get(lane.arm) ?? []) draw_halt(g, sheet, row, halt, lit.arms.length > 0 && !lit.arms.includes(lane.arm));
    for (const mark of drawn[i] ?? []) draw_mark(g, sheet, row, mark, is_dim(mark, lane.arm, lit), mark === hover);
  });
  lanes.forEach((lane, i) => draw_threads(g, sheet, lane, i, rows, arms, hover));
  draw_events(g, sheet, lit.events, pointed.events);
  draw_now(g, sheet, now_in_words(lit.stale));
  if (lit.shown_s !== null) draw_shown_time(g, sheet, lit.shown_s);
  g.restore();
  rows.forEach((row, i) => draw_name(g, row, lanes[i]?.arm ?? ''));
}

function row_of(sheet: Sheet, arms: readonly string[], arm: string, i: number, pauses: readonly Pick<Pause, 'from_s' | 'to_s'>[]): Row {
  const height = lane_height(sheet, arms.length);
  const roomy = height >= 30;
  const top = i * height;
  const wait_height = roomy ? Math.max(5, Math.round(height * 0.16)) : Math.max(3, Math.round(height * 0.24));
  const gap = roomy ? 4 : 1.5;
  const bar_height = Math.max(3, height - wait_height - 3 * gap);
  const bar_top = top + gap;
  const covers = [
    { from: -Infinity, to: kLeft_px }, { from: sheet.width - kRight_px, to: Infinity },
    ...pauses.map(({ from_s, to_s }) => ({ from: sheet.x(from_s), to: sheet.x(to_s ?? sheet.now_s) })),
  ];
  return { top, height, color: ink(arm_color(arms, arm)), bar_top, bar_height, wait_top: bar_top + bar_height + gap, wait_height, covers };
}

function is_dim(mark: Mark, arm: string, lit: Lit): boolean {
  if (lit.jobs.length > 0) return !lit.jobs.includes(mark.job);
  return lit.arms.length > 0 && !lit.arms.includes(arm);
}

// Largest number of labels on the axis, whatever the size of the timeline.
const kTicksMax = 1000;

function draw_axis(g: CanvasRenderingContext2D, sheet: Sheet): void {
  const step_s = tick_of(sheet.length_s, (sheet.width - kLeft_px) / 74);
  g.font = `10.5px ${kFont}`;
  g.textAlign = 'center';
  g.textBaseline = 'alphabetic';
  g.lineWidth = 1;
  const first_s = Math.ceil(sheet.from_s / step_s) * step_s;
  for (let k = 0; k <= sheet.length_s / step_s && k < kTicksMax; k += 1) {
    const t_s = first_s + k * step_s;
    if (t_s < 0) continue;
    const at = Math.round(sheet.x(t_s)) + 0.5;
    g.strokeStyle = ink('--line');
    line(g, at, 0, at, sheet.height - kAxis_px);
    g.fillStyle = ink('--faint');
    if (at > kLeft_px + 8 && at < sheet.width - 18 && Math.abs(at - sheet.x(sheet.now_s)) > 34) g.fillText(tick_label(t_s, step_s), at, sheet.height - 5);
  }
}

function tick_label(t_s: number, step_s: number): string {
  const whole = Math.floor(t_s + 1e-9);
  const clock = `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`;
  return step_s < 1 ? `${clock}.${Math.round((t_s - whole) * 10)}` : clock;
}

/** Returns the label of the line between past and future. */
export function now_in_words(stale: boolean): string {
  return stale ? kText.timeline.mark_last_data : kText.timeline.mark_now;
}

/** Draws the line at now. */
function draw_now(g: CanvasRenderingContext2D, sheet: Sheet, words: string): void {
  const at = Math.round(sheet.x(sheet.now_s)) + 0.5;
  if (at < kLeft_px || at > sheet.width - kRight_px) return;
  g.strokeStyle = ink('--text');
  g.lineWidth = 1.5;
  line(g, at, 0, at, sheet.height - kAxis_px + 3);
  g.font = `600 10.5px ${kFont}`;
  g.textAlign = 'center';
  g.textBaseline = 'alphabetic';
  g.fillStyle = ink('--text');
  g.fillText(words, Math.min(at, sheet.width - kRight_px - g.measureText(words).width / 2), sheet.height - 5);
}

function draw_shown_time(g: CanvasRenderingContext2D, sheet: Sheet, shown_s: number): void {
  const at = Math.round(sheet.x(shown_s)) + 0.5;
  g.strokeStyle = ink('--blue');
  g.lineWidth = 2;
  line(g, at, 0, at, sheet.height - kAxis_px + 3);
}

function draw_name(g: CanvasRenderingContext2D, row: Row, name: string): void {
  g.fillStyle = row.color;
  g.font = `600 ${row.height < 18 ? 10.5 : 12}px ${kFont}`;
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  g.fillText(cut(g, shown_name(name), kLeft_px - 20), 14, row.bar_top + row.bar_height / 2);
}

/** Cuts a name to the available width. */
function cut(g: CanvasRenderingContext2D, text: string, room_px: number): string {
  if (g.measureText(text).width <= room_px) return text;
  const letters = characters_of(text);
  while (letters.length > 1 && g.measureText(`${letters.join('')}…`).width > room_px) letters.length -= letters.length > 24 ? 12 : 1;
  return `${letters.join('')}…`;
}

function draw_mark(g: CanvasRenderingContext2D, sheet: Sheet, row: Row, mark: Mark, dim: boolean, hover: boolean): void {
  const left = sheet.x(mark.from_s);
  const right = Number.isFinite(mark.to_s) ? sheet.x(mark.to_s) : sheet.width;
  if (mark.stopped && !Number.isFinite(mark.to_s)) {
    draw_open_end(g, row, left);
    return;
  }
  if (right < kLeft_px || left > sheet.width) return;
  const width = right - left;
  g.globalAlpha = dim ? 0.28 : 1;
  if (mark.kind === 'wait') hatch(g, { left, top: row.wait_top, width, height: row.wait_height }, mark.stopped ? ink('--alarm') : row.color, hover);
  else if (mark.kind === 'pause') draw_pause(g, row, left, width, mark.stopped, hover);
  else if (mark.expected) draw_expected(g, row, mark, left, width, dim, hover);
  else draw_motion(g, row, mark, left, width, dim, hover);
  g.globalAlpha = 1;
}

/**
 * Draws a period in which an arm was stopped, whether it had a job or not. A stop that still lasts
 * has an open end.
 */
function draw_halt(g: CanvasRenderingContext2D, sheet: Sheet, row: Row, { from_s, to_s }: Pick<Pause, 'from_s' | 'to_s'>, dim: boolean): void {
  const left = sheet.x(from_s);
  const right = sheet.x(to_s ?? sheet.now_s);
  if (right < kLeft_px || left > sheet.width) return;
  g.globalAlpha = dim ? 0.28 : 1;
  draw_pause(g, row, left, right - left, true, false);
  if (to_s === null) draw_open_end(g, row, right);
  g.globalAlpha = 1;
}

/** Draws the end of a stop that still lasts: it fades out, because the end is unknown. */
function draw_open_end(g: CanvasRenderingContext2D, row: Row, left: number): void {
  kFading.forEach((alpha, i) => {
    g.globalAlpha = alpha;
    hatch(g, { left: left + i * kFade_px, top: row.bar_top + 1, width: kFade_px, height: row.bar_height - 2, falls: true }, ink('--alarm'), true);
  });
  g.globalAlpha = 1;
}
const kFading = [0.6, 0.35, 0.15];
const kFade_px = 2 * kHatch_px;

function draw_motion(g: CanvasRenderingContext2D, row: Row, mark: Mark, left: number, width: number, dim: boolean, hover: boolean): void {
  const failed = mark.state === 'failed' || mark.state === 'interrupted' || mark.state === 'expired';
  const live = mark.state === 'running' || mark.state === 'paused';
  const strength = live || hover ? 1 : mark.state === 'canceled' ? 0.22 : 0.4;
  g.globalAlpha = (dim ? 0.3 : 1) * strength;
  g.fillStyle = failed ? ink('--alarm') : row.color;
  bar(g, left, row.bar_top, width - 1, row.bar_height);
  g.fill();
  g.globalAlpha = dim ? 0.4 : 1;
  label(g, row, mark, left, width, live || hover ? ink('--on-bar') : ink('--text'));
}

function draw_expected(g: CanvasRenderingContext2D, row: Row, mark: Mark, left: number, width: number, dim: boolean, hover: boolean): void {
  g.fillStyle = row.color;
  g.globalAlpha = (dim ? 0.3 : 1) * (hover ? 0.35 : 0.13);
  bar(g, left + 0.5, row.bar_top + 0.5, width - 2, row.bar_height - 1);
  g.fill();
  g.globalAlpha = dim ? 0.3 : 0.9;
  g.strokeStyle = row.color;
  g.lineWidth = 1;
  g.stroke();
  label(g, row, mark, left, width, ink('--text'));
}

/** Draws a pause or a stop as a hatched bar over the motion. */
function draw_pause(g: CanvasRenderingContext2D, row: Row, left: number, width: number, stopped: boolean, hover: boolean): void {
  g.fillStyle = ink('--panel');
  g.fillRect(left, row.bar_top, width, row.bar_height);
  hatch(g, { left, top: row.bar_top + 1, width, height: row.bar_height - 2, falls: true }, ink(stopped ? '--alarm' : '--paused'), hover || stopped);
}

function bar(g: CanvasRenderingContext2D, left: number, top: number, width: number, height: number): void {
  const wide = Math.max(kLeast_px, width);
  g.beginPath();
  g.roundRect(left, top, wide, height, Math.min(3, wide / 2));
}

/**
 * Writes the longest form of the job's name that fits the visible part of the bar. If no form fits,
 * nothing is written.
 */
function label(g: CanvasRenderingContext2D, row: Row, mark: Mark, left: number, width: number, color: string): void {
  if (row.bar_height < 11 || width < 16) return;
  g.font = `500 10.5px ${kFont}`;
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  const seen = widest_free({ from: left, to: left + width }, row.covers);
  if (!seen) return;
  const room = seen.to - seen.from - 9;
  const name = shown_name(mark.label);
  const text = [name, name.replace(/^[^:]*: /, ''), short_id(mark.job)].find((name) => name !== '' && g.measureText(name).width < room);
  if (!text) return;
  g.fillStyle = color;
  g.fillText(text, seen.from + 5, row.bar_top + row.bar_height / 2 + 0.5);
}

/**
 * Draws a line from the end of each predicted wait or pause to the lane of the arm that blocks it.
 */
function draw_threads(g: CanvasRenderingContext2D, sheet: Sheet, lane: Lane, i: number, rows: readonly Row[], arms: readonly string[], hover: Mark | null): void {
  const from = rows[i];
  if (!from) return;
  for (const mark of lane.marks) {
    const to = rows[arms.indexOf(mark.waits_on?.arm ?? '')];
    if (mark.kind === 'motion' || !mark.expected || !to || to === from || !Number.isFinite(mark.to_s)) continue;
    const at = sheet.x(mark.to_s);
    const down = to.top > from.top;
    const y0 = mark.kind === 'wait' ? from.wait_top + (down ? from.wait_height : 0) : from.bar_top + (down ? from.bar_height : 0);
    const y1 = to.bar_top + (down ? 0 : to.bar_height);
    g.globalAlpha = mark === hover ? 1 : 0.75;
    g.strokeStyle = to.color;
    g.fillStyle = to.color;
    g.lineWidth = mark === hover ? 2 : 1.2;
    line(g, at, y0, at, y1);
    g.beginPath();
    g.arc(at, y1, mark === hover ? 4 : 3, 0, 2 * Math.PI);
    g.fill();
    g.globalAlpha = 1;
  }
}

/**
 * An area with stripes. Rising stripes are waits, falling stripes are pauses, so that they differ
 * without colors.
 */
interface Stripes { left: number; top: number; width: number; height: number; falls?: boolean }

function hatch(g: CanvasRenderingContext2D, { left, top, width, height, falls = false }: Stripes, color: string, strong: boolean): void {
  g.save();
  g.beginPath();
  g.rect(left, top, width, height);
  g.clip();
  g.globalAlpha *= strong ? 1 : 0.7;
  g.strokeStyle = color;
  g.lineWidth = strong ? 1.8 : 1.2;
  // The stripes are anchored to the start of the bar, so that they move with the bar.
  const shown = Math.max(left, 0);
  const first = shown - ((shown - left) % kHatch_px) - height - kHatch_px;
  const last = Math.min(left + width, g.canvas.width);
  for (let at = first; at < last; at += kHatch_px) line(g, at, falls ? top : top + height, at + height, falls ? top + height : top);
  g.restore();
}

function line(g: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  g.beginPath();
  g.moveTo(x0, y0);
  g.lineTo(x1, y1);
  g.stroke();
}
