// One lane per arm. Left of the line that is now: solid bars where it executed a job, hatched where a
// job waited, from the jobs' own times. Right of it what the server expects: outlined bars for what is
// admitted, hatched where it will stand.

import { useEffect, useRef } from 'preact/hooks';
import type { Forecast, ForecastLeg, Job } from '../messages';
import { arm_colour } from '../palette';
import type { Store } from '../store';
import { clock, short_id, wait_in_words } from '../wording';

const kPast_s = 40;
const kFuture_s = 20;
const kWindow_s = kPast_s + kFuture_s;
const kRedraw_ms = 200;
const kLeft_px = 64;
const kRight_px = 12;
const kAxis_px = 18;

type Follow = (take: (forecast: Forecast | null) => void) => () => void;

export function Timeline({ store, follow }: { store: Store; follow: Follow }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const forecast = useRef<Forecast | null>(null);
  useEffect(() => {
    let last_ms = 0;
    const draw = () => {
      const now_ms = performance.now();
      if (!canvas.current || now_ms - last_ms < kRedraw_ms) return;
      last_ms = now_ms;
      draw_timeline(canvas.current, store, forecast.current);
    };
    const off = [store.on_frame(draw), store.on_change(draw), follow((answer) => { forecast.current = answer; draw(); })];
    const observer = new ResizeObserver(() => { last_ms = 0; draw(); });
    if (canvas.current) observer.observe(canvas.current);
    return () => {
      observer.disconnect();
      for (const f of off) f();
    };
  }, [store, follow]);
  return (
    <section class="timeline">
      <h2>Timeline<span class="count">last {kPast_s} s, next {kFuture_s} s</span>
        <span class="grow" />
        <span class="key"><i class="solid" /> runs</span><span class="key"><i class="hatched" /> waits</span>
        <span class="key"><i class="outlined" /> expected</span>
      </h2>
      <canvas ref={canvas} role="img" aria-label="What each arm did lately, and is expected to do"
        onPointerMove={(event) => { event.currentTarget.title = told_at(event, store, forecast.current); }} />
    </section>
  );
}

interface Lane { name: string; colour: string; top: number; height: number }
interface Sheet { g: CanvasRenderingContext2D; width: number; height: number; now_s: number; x(t_s: number): number }

function draw_timeline(canvas: HTMLCanvasElement, store: Store, forecast: Forecast | null): void {
  const sheet = fit(canvas, store.t_s);
  if (!sheet) return;
  draw_axis(sheet);
  const names = [...store.arms.keys()];
  const lane_height = height_of_lanes(sheet.height, names.length);
  const jobs = store.all_jobs();
  names.forEach((name, i) => {
    const lane: Lane = { name, colour: arm_colour(names, name), top: i * lane_height, height: lane_height };
    draw_lane(sheet, lane, jobs.filter((job) => job.arms.includes(name)));
    for (const leg of forecast?.arms.find((arm) => arm.name === name)?.legs ?? []) draw_leg(sheet, lane, leg);
  });
}

const height_of_lanes = (height: number, lanes: number) => Math.min(58, (height - kAxis_px) / Math.max(1, lanes));
const wait_height_of = (lane: Lane) => Math.max(4, Math.round(lane.height * 0.16));
const bar_height_of = (lane: Lane) => lane.height - wait_height_of(lane) - 12;

/** What is to come of it: its outline, hatched where it stands. A server's time that is past by now ends at now. */
function draw_leg({ g, width, now_s, x }: Sheet, lane: Lane, leg: ForecastLeg): void {
  const end_s = now_s + kFuture_s;
  const from_s = Math.max(now_s, leg.starts_s ?? end_s);
  const to_s = Math.min(end_s, leg.ends_s ?? end_s);
  g.save();
  g.beginPath();
  g.rect(x(now_s), lane.top, width - kRight_px - x(now_s), lane.height);
  g.clip();
  const top = lane.top + 5;
  const height = bar_height_of(lane);
  g.globalAlpha = 0.75;
  g.strokeStyle = lane.colour;
  g.lineWidth = 1;
  if (to_s > from_s) {
    g.beginPath();
    g.roundRect(x(from_s) + 0.5, top + 0.5, Math.max(2, x(to_s) - x(from_s) - 2), height - 1, 3);
    g.stroke();
  }
  g.globalAlpha = 1;
  for (const pause of leg.pauses) {
    const [begin_s, stop_s] = [Math.max(now_s, pause.from_s), Math.min(end_s, pause.to_s ?? end_s)];
    if (stop_s <= begin_s) continue;
    // On its way within its bar; before its start as whoever waits.
    if (pause.at_s > 0) hatch(g, x(begin_s), top + 1, x(stop_s) - x(begin_s), height - 2, lane.colour);
    else hatch(g, x(begin_s), top + height + 3, x(stop_s) - x(begin_s), wait_height_of(lane), lane.colour);
  }
  g.restore();
}

/** Of the future under the pointer: which job, when, and whom it waits for there. */
function told_at(event: PointerEvent, store: Store, forecast: Forecast | null): string {
  const canvas = event.currentTarget as HTMLCanvasElement;
  const t_s = store.t_s - kPast_s + (event.offsetX - kLeft_px) / ((canvas.clientWidth - kLeft_px - kRight_px) / kWindow_s);
  const names = [...store.arms.keys()];
  const name = names[Math.floor(event.offsetY / height_of_lanes(canvas.clientHeight, names.length))];
  if (!forecast || name === undefined || t_s < store.t_s) return '';
  const holds = (from_s: number, to_s: number | null) => from_s <= t_s && t_s <= (to_s ?? Infinity);
  const arm = forecast.arms.find((lane) => lane.name === name);
  for (const leg of arm?.legs ?? []) {
    const title = leg.name || short_id(leg.id);
    const pause = leg.pauses.find((p) => holds(p.from_s, p.to_s));
    if (pause) {
      const why = pause.waits_on ? wait_in_words(pause.waits_on) : 'stands, for a reason of its own';
      return `${title} ${why}${pause.to_s === null ? '' : `, until ${clock(pause.to_s)}`}`;
    }
    if (leg.starts_s !== null && holds(leg.starts_s, leg.ends_s)) return `${title}, ${clock(leg.starts_s)} to ${leg.ends_s === null ? 'no end as things are' : clock(leg.ends_s)}`;
  }
  return arm?.waiting ? `${arm.waiting} more wait` : '';
}

function fit(canvas: HTMLCanvasElement, now_s: number): Sheet | null {
  const { clientWidth: width, clientHeight: height } = canvas;
  const g = canvas.getContext('2d');
  if (!g || width === 0 || height === 0) return null;
  const ratio = Math.min(2, window.devicePixelRatio);
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, width, height);
  const per_s = (width - kLeft_px - kRight_px) / kWindow_s;
  return { g, width, height, now_s, x: (t_s) => kLeft_px + (t_s - now_s + kPast_s) * per_s };
}

function draw_axis({ g, width, height, now_s, x }: Sheet): void {
  g.font = '10.5px "Inter Variable", system-ui, sans-serif';
  g.textAlign = 'center';
  g.textBaseline = 'alphabetic';
  g.lineWidth = 1;
  for (let t_s = Math.ceil((now_s - kPast_s) / 10) * 10; t_s <= now_s + kFuture_s; t_s += 10) {
    if (t_s < 0) continue;
    const at = Math.round(x(t_s)) + 0.5;
    g.strokeStyle = '#1f2732';
    line(g, at, 0, at, height - kAxis_px);
    g.fillStyle = '#6b7787';
    const label = `${Math.floor(t_s / 60)}:${String(t_s % 60).padStart(2, '0')}`;
    if (at > kLeft_px + 8 && at < width - 18) g.fillText(label, at, height - 5);
  }
  g.strokeStyle = '#5b6b80';
  line(g, Math.round(x(now_s)) + 0.5, 0, Math.round(x(now_s)) + 0.5, height - kAxis_px);
}

function draw_lane(sheet: Sheet, lane: Lane, jobs: Job[]): void {
  const { g, width, now_s, x } = sheet;
  const from_s = now_s - kPast_s;
  const wait_height = wait_height_of(lane);
  const bar_top = lane.top + 5;
  const bar_height = bar_height_of(lane);
  g.save();
  g.beginPath();
  g.rect(kLeft_px, lane.top, width - kLeft_px - kRight_px, lane.height);
  g.clip();
  for (const job of jobs) {
    const submitted_s = job.submitted_s;
    const waited_until_s = job.started_s ?? job.ended_s ?? now_s;
    if (submitted_s !== null && waited_until_s - submitted_s > 0.05 && waited_until_s > from_s) {
      const waits_top = bar_top + bar_height + 3;
      hatch(g, x(submitted_s), waits_top, x(waited_until_s) - x(submitted_s), wait_height, lane.colour);
    }
    if (job.started_s === null || (job.ended_s ?? now_s) < from_s) continue;
    draw_bar(g, job, x(job.started_s), bar_top, x(job.ended_s ?? now_s) - x(job.started_s), bar_height, lane.colour);
  }
  g.restore();
  g.fillStyle = lane.colour;
  g.font = '600 12px "Inter Variable", system-ui, sans-serif';
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  g.fillText(lane.name, 12, bar_top + bar_height / 2, kLeft_px - 16);
}

function draw_bar(g: CanvasRenderingContext2D, job: Job, left: number, top: number, width: number, height: number, colour: string): void {
  const failed = job.state === 'failed' || job.state === 'interrupted' || job.state === 'expired';
  const cut = job.state === 'canceled' || job.state === 'holding';
  const wide = Math.max(2, width - 1);
  const live = job.state === 'running';
  g.globalAlpha = live ? 1 : cut ? 0.2 : 0.38;
  g.fillStyle = failed ? '#f2565e' : colour;
  g.beginPath();
  g.roundRect(left, top, wide, height, Math.min(3, wide / 2));
  g.fill();
  g.globalAlpha = 1;
  g.font = '500 10.5px "Inter Variable", system-ui, sans-serif';
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  g.fillStyle = live ? '#0b1016' : '#dce2ea';
  // The longest name that fits whole; a cut one says nothing.
  const label = [job.name, short_id(job.id)].find((text) => text !== '' && g.measureText(text).width < wide - 10);
  if (label) g.fillText(label, left + 5, top + height / 2 + 0.5);
}

function hatch(g: CanvasRenderingContext2D, left: number, top: number, width: number, height: number, colour: string): void {
  g.save();
  g.beginPath();
  g.rect(left, top, width, height);
  g.clip();
  g.globalAlpha = 0.5;
  g.strokeStyle = colour;
  g.lineWidth = 1.2;
  const step = 5;
  // Stripes are anchored to the bar's start, so that they travel with it.
  const first = Math.max(left, -step * 4) - ((Math.max(left, -step * 4) - left) % step) - height;
  for (let at = first; at < left + width; at += step) line(g, at, top + height, at + height, top);
  g.restore();
}

function line(g: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  g.beginPath();
  g.moveTo(x0, y0);
  g.lineTo(x1, y1);
  g.stroke();
}
