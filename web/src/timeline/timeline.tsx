// The timeline: one lane for each arm. The past is left of now, the prediction right of now. The
// shown range follows now, or is fixed by the address, the scrub bar, a drag or keys.

import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { use_stale } from '../frame/staleness';
import { selection_of } from '../route/selection';
import type { App } from '../state/app';
import { event_beside, events_in_words, type EventMark } from './events';
import { is_of_this_run } from '../state/instant';
import { known_lanes } from './known';
import { paint } from './paint';
import { kNothing, pointing, tip_of, type Drawing, type Tip } from './pointing';
import { fit, sheet_of } from './sheet';
import { around, begin_of, kFollowing, moved, zoomed, type Span } from './span';
import { ScrubBar } from './scrub_bar';
import { TextList } from './text_list';
import { kText } from '../strings';

const kWords = kText.timeline;

const kRedraw_ms = 100;
export function Timeline({ app }: { app: App }) {
  const { store, router, settings } = app;
  const canvas = useRef<HTMLCanvasElement>(null);
  const drawing = useRef<Drawing>({ span: kFollowing, lanes: [], sheet: null, pointed: kNothing, drag: null });
  const [span, set_span] = useState<Span>(kFollowing);
  const [tip, set_tip] = useState<Tip | null>(null);
  const [chosen, set_chosen] = useState('');
  const shown_s = router.address.value.t_s;
  const change = (next: Span) => {
    drawing.current.span = next;
    set_span(next);
  };
  // This is a layout effect, because it must run before the next key press.
  useLayoutEffect(() => {
    const { span: now } = drawing.current;
    change(shown_s === null ? { ...now, fixed_from_s: null } : is_shown(now, shown_s, store.t_s) ? now : around(now, shown_s));
  }, [shown_s]);
  const stale = use_stale(store);
  const is_stale = useRef(stale);
  is_stale.current = stale;
  const draw = useRef(() => {});
  useEffect(() => {
    draw.current = () => { if (canvas.current) draw_now(canvas.current, drawing.current, app, is_stale.current); };
    return drive(canvas, store, () => draw.current());
  }, [app]);
  const clear_pointed = () => {
    if (drawing.current.pointed === kNothing) return;
    drawing.current.pointed = kNothing;
    set_tip(null);
    draw.current();
  };
  // Escape closes the tooltip, whichever element has the focus.
  useLayoutEffect(() => {
    if (!tip) return;
    const on_escape = (event: KeyboardEvent) => { if (event.key === 'Escape') clear_pointed(); };
    window.addEventListener('keydown', on_escape);
    return () => window.removeEventListener('keydown', on_escape);
  }, [tip !== null]);
  /** Shows the event that the user chose by keys, and announces it to screen readers. */
  const choose = (event: EventMark) => {
    const { span: now } = drawing.current;
    change(is_shown({ ...now, fixed_from_s: begin_of(now, store.t_s) }, event.t_s, store.t_s) ? moved(now, 0, store.t_s) : around(now, event.t_s));
    drawing.current.pointed = { mark: null, events: [event] };
    draw.current();
    const { sheet } = drawing.current;
    if (sheet) set_tip(tip_of([event], sheet, store.t_s));
    set_chosen(events_in_words([event], store.t_s));
  };
  /** Handles a key. Returns false if the key has no meaning in the timeline. */
  const by_key = (key: string): boolean => {
    const [at = null] = drawing.current.pointed.events;
    if (key === 'PageUp' || key === 'PageDown') {
      const event = event_beside(store.events, at, key === 'PageUp' ? -1 : 1);
      if (event) choose(event);
      return true;
    }
    if (key === 'Enter' && at) {
      router.show_time(at.t_s);
      return true;
    }
    const next = span_by_key(key, drawing.current.span, store.t_s);
    if (!next) return false;
    if (key === '0') router.show_time(null);
    change(next);
    return true;
  };
  const theme = settings.shown_theme.value;
  const address = router.address.value;
  useEffect(() => draw.current(), [span, theme, address, stale]);
  return (
    <section class="timeline" aria-label={kWords.title}>
      <div class={`line head${shown_s === null ? '' : ' looks-back'}`}>
        <h2>{kWords.title}</h2>
        <Keys />
        <details class="legend"><summary class="small">{kWords.legend}</summary><div class="legend-keys"><Keys /></div></details>
        <span class="grow" />
        <ScrubBar app={app} />
        <button class="small" aria-label={kWords.zoom_out} title={kWords.zoom_out_title} onClick={() => change(zoomed(span, 1.5, store.t_s))}>−</button>
        <button class="small" aria-label={kWords.zoom_in} title={kWords.zoom_in_title} onClick={() => change(zoomed(span, 1 / 1.5, store.t_s))}>+</button>
        <button class="small" data-test="follow-now" aria-pressed={span.fixed_from_s === null && shown_s === null} title={kWords.now_title}
          onClick={() => { router.show_time(null); change({ ...span, fixed_from_s: null }); }}>{kWords.now}</button>
      </div>
      <div class="sheet">
        <canvas ref={canvas} tabIndex={0} role="img" data-test="lanes" data-from={span.fixed_from_s ?? 'now'} data-length={span.length_s}
          aria-label={kWords.label}
          {...pointing(drawing.current, app, change, set_tip, () => draw.current())}
          onBlur={() => clear_pointed()} onKeyDown={(event) => { if (by_key(event.key)) event.preventDefault(); }} />
        <span class="sr-only" role="status">{chosen}</span>
        {tip && <div class="tip" role="tooltip" style={{ left: `${tip.x}px`, bottom: `${tip.up}px` }}>{tip.words}</div>}
      </div>
      <TextList app={app} />
    </section>
  );
}

/** The legend. It is shown in the heading if there is room, else behind a button. */
function Keys() {
  return (
    <>
      <span class="key"><i class="solid" /> {kWords.keys.moves}</span><span class="key"><i class="outlined" /> {kWords.keys.expected}</span>
      <span class="key"><i class="hatched" /> {kWords.keys.waits}</span><span class="key"><i class="hatched pausing" /> {kWords.keys.paused}</span><span class="key"><i class="hatched stopping" /> {kWords.keys.stopped}</span><span class="key"><i class="event" /> {kWords.keys.event}</span>
    </>
  );
}

function is_shown(span: Span, t_s: number, now_s: number): boolean {
  const sheet = sheet_of(100, 100, span, now_s);
  return span.fixed_from_s !== null && t_s >= sheet.from_s && t_s <= sheet.from_s + sheet.length_s;
}

/** Redraws when the data changes, at most ten times per second, and when the canvas is resized. */
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

function draw_now(canvas: HTMLCanvasElement, drawing: Drawing, app: App, stale: boolean): void {
  const g = fit(canvas);
  if (!g) return;
  drawing.sheet = sheet_of(canvas.clientWidth, canvas.clientHeight, drawing.span, app.store.t_s);
  drawing.lanes = known_lanes(app, drawing.sheet.from_s);
  const { jobs, arms } = selection_of(app.router.place, app.store);
  const at = app.router.address.peek();
  const shown_s = is_of_this_run(at.run, app.store) ? at.t_s : null;
  paint(g, drawing.sheet, drawing.lanes, { jobs, arms, shown_s, stale, events: app.store.events, halts: app.store.halts }, drawing.pointed);
}

function span_by_key(key: string, span: Span, now_s: number): Span | null {
  switch (key) {
    case 'ArrowLeft': return moved(span, -span.length_s / 10, now_s);
    case 'ArrowRight': return moved(span, span.length_s / 10, now_s);
    case '+': case '=': return zoomed(span, 1 / 1.5, now_s);
    case '-': return zoomed(span, 1.5, now_s);
    case '0': return { ...span, fixed_from_s: null };
    default: return null;
  }
}

