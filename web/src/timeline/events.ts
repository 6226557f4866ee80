// Events as marks on the axis of the timeline: how they are drawn, pointed at, stepped through by
// keys, and put into text. Pure except for drawing.

import { ink } from '../state/palette';
import type { Notice } from '../state/notices';
import { clock, seconds } from '../wording';
import { kAxis_px, kLeft_px, kRight_px, type Sheet } from './sheet';
import { shown_name, shown_text } from '../names';
import { kText } from '../strings';

const kWords = kText.timeline;

export type EventMark = Pick<Notice, 'key' | 't_s' | 'level' | 'text' | 'arms'>;

const kColors: Record<EventMark['level'], string> = { info: '--dim', warning: '--amber', error: '--red' };
const kNames: Record<EventMark['level'], string> = { info: kWords.note, warning: kWords.warning, error: kWords.error };
const kHeight_px = 9;
// How far from a mark the pointer may be, because marks are narrower than a pointer is precise.
const kReach_px = 7;
const kMostTold = 3;

/**
 * Draws a bar or a triangle for each event, by its level. The newest event is on top. The events
 * `looked_at` have an outline.
 */
export function draw_events(g: CanvasRenderingContext2D, sheet: Sheet, events: readonly EventMark[], looked_at: readonly EventMark[]): void {
  const foot = sheet.height - kAxis_px;
  for (const event of [...events].reverse()) {
    const at = Math.round(sheet.x(event.t_s));
    if (at < kLeft_px || at > sheet.width) continue;
    g.fillStyle = ink(kColors[event.level]);
    g.beginPath();
    if (event.level === 'info') g.rect(at - 1, foot - 6, 2, 6);
    else for (const [x, y] of [[at, foot - 8], [at + 5, foot], [at - 5, foot]] as const) g.lineTo(x, y);
    g.closePath();
    g.fill();
    if (!looked_at.includes(event)) continue;
    g.strokeStyle = ink('--text');
    g.lineWidth = 2;
    g.stroke();
  }
}

/**
 * Returns the events at a point of the timeline, newest first. Returns none if the point is outside
 * of the strip with the marks.
 */
export function events_at(events: readonly EventMark[], sheet: Sheet, x: number, y: number): EventMark[] {
  const foot = sheet.height - kAxis_px;
  if (y < foot - kHeight_px - 3 || y > sheet.height) return [];
  const found = events.filter((event) => Math.abs(sheet.x(event.t_s) - x) <= kReach_px && is_in(sheet, event));
  const nearest = found.reduce<EventMark | null>((best, event) => (best && Math.abs(sheet.x(best.t_s) - x) <= Math.abs(sheet.x(event.t_s) - x) ? best : event), null);
  // Events whose marks cover each other are listed together.
  return nearest ? found.filter((event) => Math.abs(sheet.x(event.t_s) - sheet.x(nearest.t_s)) <= 2) : [];
}

function is_in(sheet: Sheet, { t_s }: EventMark): boolean {
  const x = sheet.x(t_s);
  return x >= kLeft_px && x <= sheet.width - kRight_px;
}

/**
 * Returns the next later event if `by` is 1, the next earlier event if it is -1. Without `from`
 * returns the newest event.
 */
export function event_beside(events: readonly EventMark[], from: EventMark | null, by: 1 | -1): EventMark | null {
  if (events.length === 0) return null;
  const at = from ? events.findIndex(({ key }) => key === from.key) : -1;
  if (at < 0) return events[0] ?? null;
  return events[Math.min(events.length - 1, Math.max(0, at - by))] ?? null;
}

/** Returns one line for each event: its level, its time, its text, and its arms. */
export function events_in_words(events: readonly EventMark[], now_s: number): string {
  const lines = events.slice(0, kMostTold).map((event) => event_in_words(event, now_s));
  if (events.length > kMostTold) lines.push(kWords.and_more(events.length - kMostTold));
  return lines.join('\n');
}

function event_in_words({ level, t_s, text, arms }: EventMark, now_s: number): string {
  const unnamed = arms.filter((arm) => !names(text, arm));
  const of = unnamed.length === 0 ? '' : ` (${unnamed.map(shown_name).join(kText.server.and)})`;
  return kWords.event(kNames[level], clock(t_s), seconds(Math.max(0, now_s - t_s)), shown_text(text), of);
}

/**
 * Returns true if the text contains the arm's name as a whole word. A link's name that begins with
 * the arm's name does not count.
 */
function names(text: string, arm: string): boolean {
  return text.split(/[^\p{L}\p{N}_-]+/u).includes(arm);
}
