// The timeline: a lane for each arm, what it did left of now and what is expected right of it. It
// follows now, or is held where the address, the scrub bar, a drag or the keys have put it.

import { useEffect, useRef, useState } from 'preact/hooks';
import { selection_of } from '../route/selection';
import type { App } from '../state/app';
import { lanes_of, mark_at, type Lane, type Mark } from './lanes';
import { paint } from './paint';
import { fit, lane_at, sheet_of, type Sheet } from './sheet';
import { around, kFollowing, moved, zoomed, type Span } from './span';
import { ScrubBar } from './scrub_bar';
import { Told } from './told_list';
import { mark_in_words } from './told';

const kRedraw_ms = 100;
const kClick_px = 4;
// A motion that ended before what is shown tells since when its arm could have gone on.
const kBefore_s = 60;

/** What is drawn and what is pointed at; changes many times a second, so no component's state. */
interface Drawing { span: Span; lanes: Lane[]; sheet: Sheet | null; hover: Mark | null }

export function Timeline({ app }: { app: App }) {
  const { store, router, settings } = app;
  const canvas = useRef<HTMLCanvasElement>(null);
  const drawing = useRef<Drawing>({ span: kFollowing, lanes: [], sheet: null, hover: null });
  const [span, set_span] = useState<Span>(kFollowing);
  const [tip, set_tip] = useState<Tip | null>(null);
  const held_s = router.address.value.t_s;
  const change = (next: Span) => {
    drawing.current.span = next;
    set_span(next);
  };
  useEffect(() => {
    const { span: now } = drawing.current;
    change(held_s === null ? { ...now, held_from_s: null } : is_shown(now, held_s, store.t_s) ? now : around(now, held_s, store.t_s));
  }, [held_s]);
  const draw = useRef(() => {});
  useEffect(() => {
    draw.current = () => { if (canvas.current) draw_now(canvas.current, drawing.current, app); };
    return drive(canvas, store, () => draw.current());
  }, [app]);
  const theme = settings.shown_theme.value;
  const address = router.address.value;
  useEffect(() => draw.current(), [span, theme, address]);
  return (
    <section class="timeline" aria-label="Timeline">
      <div class={`line head${held_s === null ? '' : ' looks-back'}`}>
        <h2>Timeline</h2>
        <span class="key"><i class="solid" /> ran, runs</span><span class="key"><i class="outlined" /> expected</span>
        <span class="key"><i class="hatched" /> waits</span><span class="key"><i class="hatched pausing" /> stands on its way</span><span class="key"><i class="event" /> event</span>
        <span class="grow" />
        <ScrubBar app={app} />
        <button class="small" aria-label="Zoom out" title="Zoom out (−)" onClick={() => change(zoomed(span, 1.5, store.t_s))}>−</button>
        <button class="small" aria-label="Zoom in" title="Zoom in (+)" onClick={() => change(zoomed(span, 1 / 1.5, store.t_s))}>+</button>
        <button class="small" data-test="follow-now" aria-pressed={span.held_from_s === null && held_s === null} title="Follow now (0)"
          onClick={() => { router.hold_at(null); change({ ...span, held_from_s: null }); }}>Now</button>
      </div>
      <div class="sheet">
        <canvas ref={canvas} tabIndex={0} role="img" aria-label="A lane for each arm: what it did, and what it is expected to do. Told below in words."
          {...pointing(drawing.current, app, change, set_tip, () => draw.current())}
          onKeyDown={(event) => {
            const next = span_by_key(event.key, drawing.current.span, store.t_s);
            if (!next) return;
            event.preventDefault();
            if (event.key === '0') router.hold_at(null);
            change(next);
          }} />
        {tip && <div class="tip" role="tooltip" style={{ left: `${tip.x}px`, bottom: `${tip.up}px` }}>{tip.words}</div>}
      </div>
      <Told app={app} />
    </section>
  );
}

function is_shown(span: Span, t_s: number, now_s: number): boolean {
  const sheet = sheet_of(100, 100, span, now_s);
  return span.held_from_s !== null && t_s >= sheet.from_s && t_s <= sheet.from_s + sheet.length_s;
}

/** Draws as the store changes, ten times a second at most, and as the canvas changes its size. */
function drive(canvas: { current: HTMLCanvasElement | null }, store: App['store'], draw: () => void): () => void {
  let last_ms = -Infinity;
  const tick = () => {
    const now_ms = performance.now();
    if (now_ms - last_ms < kRedraw_ms) return;
    last_ms = now_ms;
    draw();
  };
  const off = [store.on_frame(tick), store.on_change(tick)];
  const observer = new ResizeObserver(draw);
  if (canvas.current) observer.observe(canvas.current);
  return () => {
    observer.disconnect();
    for (const f of off) f();
  };
}

/** Of what moves or waits at a time or later. */
export function known_lanes({ store }: Pick<App, 'store'>, from_s = store.t_s): Lane[] {
  return lanes_of({
    arms: [...store.arms.keys()], jobs: store.book.since_time(from_s - kBefore_s), stands: (id) => store.book.stands(id),
    forecast: store.forecast, now_s: store.t_s,
  });
}

function draw_now(canvas: HTMLCanvasElement, drawing: Drawing, app: App): void {
  const g = fit(canvas);
  if (!g) return;
  drawing.sheet = sheet_of(canvas.clientWidth, canvas.clientHeight, drawing.span, app.store.t_s);
  drawing.lanes = known_lanes(app, drawing.sheet.from_s);
  const { jobs, arms } = selection_of(app.router.place, app.store);
  paint(g, drawing.sheet, drawing.lanes, { jobs, arms, held_s: app.router.address.peek().t_s, events: app.store.notices }, drawing.hover);
}

interface Tip { x: number; up: number; words: string }

/** What the pointer does: tells what is under it, moves the sheet, zooms, leads to a job. */
function pointing(drawing: Drawing, app: App, change: (span: Span) => void, tell: (tip: Tip | null) => void, draw: () => void) {
  let from: { x: number; span: Span } | null = null;
  let travelled = 0;
  const found = (event: MouseEvent): Mark | null => {
    const { sheet, lanes } = drawing;
    const lane = sheet ? lanes[lane_at(sheet, lanes.length, event.offsetY)] : undefined;
    return sheet && lane ? mark_at(lane, sheet.t_s(event.offsetX)) : null;
  };
  return {
    onPointerDown: (event: PointerEvent) => {
      from = { x: event.offsetX, span: drawing.span };
      travelled = 0;
      (event.currentTarget as HTMLCanvasElement).setPointerCapture(event.pointerId);
    },
    onPointerMove: (event: PointerEvent) => {
      const { sheet } = drawing;
      if (from && sheet) {
        travelled = Math.max(travelled, Math.abs(event.offsetX - from.x));
        if (travelled > kClick_px) return change(moved(from.span, sheet.t_s(from.x) - sheet.t_s(event.offsetX), app.store.t_s));
      }
      const mark = found(event);
      drawing.hover = mark;
      draw();
      if (!mark || !sheet) return tell(null);
      const x = Math.min(Math.max(event.offsetX, 140), sheet.width - 140);
      tell({ x, up: sheet.height - event.offsetY + 12, words: mark_in_words(mark, app.store.t_s) });
    },
    onPointerUp: (event: PointerEvent) => {
      const mark = from && travelled <= kClick_px ? found(event) : null;
      from = null;
      if (mark) app.router.go({ page: 'job', id: mark.job });
    },
    onPointerLeave: () => {
      drawing.hover = null;
      tell(null);
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

function span_by_key(key: string, span: Span, now_s: number): Span | null {
  switch (key) {
    case 'ArrowLeft': return moved(span, -span.length_s / 10, now_s);
    case 'ArrowRight': return moved(span, span.length_s / 10, now_s);
    case '+': case '=': return zoomed(span, 1 / 1.5, now_s);
    case '-': return zoomed(span, 1.5, now_s);
    case '0': return { ...span, held_from_s: null };
    default: return null;
  }
}

