// Actions of the pointer on the timeline: show a tooltip, drag, zoom, open a job, go to the time of
// an event.

import type { App } from '../state/app';
import { events_at, events_in_words, type EventMark } from './events';
import { mark_at, type Lane } from './lanes';
import type { Pointed } from './paint';
import { kAxis_px, lane_at, type Sheet } from './sheet';
import { moved, zoomed, type Span } from './span';
import { mark_in_words } from './mark_words';

/** The state of the drawing. It is not component state, because it changes too often. */
export interface Drawing { span: Span; lanes: Lane[]; sheet: Sheet | null; pointed: Pointed; drag: Drag | null }

/**
 * The place where a drag began, and the range at that time. It is kept when the timeline is drawn
 * again.
 */
interface Drag { x: number; span: Span; travelled_px: number }

export interface Tip { x: number; up: number; words: string }

export const kNothing: Pointed = { mark: null, events: [] };

const kClick_px = 4;
const kTipHalf_px = 140;
const kAboveAxis_px = 12;

export function tip_of(events: readonly EventMark[], sheet: Sheet, now_s: number): Tip {
  return { x: beside_rims(sheet.x(events[0]?.t_s ?? now_s), sheet), up: kAxis_px + kAboveAxis_px, words: events_in_words(events, now_s) };
}

function beside_rims(x: number, sheet: Sheet): number {
  return Math.min(Math.max(x, kTipHalf_px), sheet.width - kTipHalf_px);
}

export function pointing(drawing: Drawing, app: App, change: (span: Span) => void, show_tip: (tip: Tip | null) => void, draw: () => void) {
  const found = (event: MouseEvent): Pointed => {
    const { sheet, lanes } = drawing;
    if (!sheet) return kNothing;
    const events = events_at(app.store.events, sheet, event.offsetX, event.offsetY);
    if (events.length > 0) return { mark: null, events };
    const lane = lanes[lane_at(sheet, lanes.length, event.offsetY)];
    return { mark: lane ? mark_at(lane, sheet.t_s(event.offsetX)) : null, events };
  };
  const tip_at = ({ mark, events }: Pointed, sheet: Sheet, event: MouseEvent): Tip | null => {
    const now_s = app.store.t_s;
    if (events.length > 0) return tip_of(events, sheet, now_s);
    return mark && { x: beside_rims(event.offsetX, sheet), up: sheet.height - event.offsetY + 12, words: mark_in_words(mark, now_s) };
  };
  return {
    onPointerDown: (event: PointerEvent) => {
      drawing.drag = { x: event.offsetX, span: moved(drawing.span, 0, app.store.t_s), travelled_px: 0 };
      (event.currentTarget as HTMLCanvasElement).setPointerCapture(event.pointerId);
    },
    onPointerMove: (event: PointerEvent) => {
      const { sheet, drag } = drawing;
      if (drag && sheet) {
        drag.travelled_px = Math.max(drag.travelled_px, Math.abs(event.offsetX - drag.x));
        if (drag.travelled_px > kClick_px) {
          show_tip(null);
          return change(moved(drag.span, sheet.t_s(drag.x) - sheet.t_s(event.offsetX), app.store.t_s));
        }
      }
      const pointed = found(event);
      drawing.pointed = pointed;
      (event.currentTarget as HTMLCanvasElement).classList.toggle('leads', pointed.mark !== null || pointed.events.length > 0);
      draw();
      show_tip(sheet && tip_at(pointed, sheet, event));
    },
    onPointerUp: (event: PointerEvent) => {
      const { mark, events: [first] } = drawing.drag && drawing.drag.travelled_px <= kClick_px ? found(event) : kNothing;
      drawing.drag = null;
      if (mark) app.router.go({ page: 'job', id: mark.job });
      else if (first) app.router.show_time(first.t_s);
    },
    onPointerCancel: () => { drawing.drag = null; },
    onPointerLeave: () => {
      drawing.pointed = kNothing;
      show_tip(null);
      draw();
    },
    onWheel: (event: WheelEvent) => {
      event.preventDefault();
      const { sheet, span } = drawing;
      if (!sheet) return;
      const share = Math.min(1, Math.max(0, (sheet.t_s(event.offsetX) - sheet.from_s) / sheet.length_s));
      change(zoomed(span, event.deltaY > 0 ? 1.2 : 1 / 1.2, app.store.t_s, share));
    },
  };
}
