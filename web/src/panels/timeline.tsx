// The last minute, one lane per arm: solid bars where it executed a job, hatched where a job waited.
// Everything is read from the jobs' own times; nothing is remembered here.

import { useEffect, useRef } from 'preact/hooks';
import type { Job } from '../messages';
import { arm_colour } from '../palette';
import type { Store } from '../store';
import { short_id } from '../wording';

const kWindow_s = 60;
const kRedraw_ms = 200;
const kLeft_px = 64;
const kRight_px = 12;
const kAxis_px = 18;

export function Timeline({ store }: { store: Store }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    let last_ms = 0;
    const draw = () => {
      const now_ms = performance.now();
      if (!canvas.current || now_ms - last_ms < kRedraw_ms) return;
      last_ms = now_ms;
      draw_timeline(canvas.current, store);
    };
    const off = [store.on_frame(draw), store.on_change(draw)];
    const observer = new ResizeObserver(() => { last_ms = 0; draw(); });
    if (canvas.current) observer.observe(canvas.current);
    return () => {
      observer.disconnect();
      for (const f of off) f();
    };
  }, [store]);
  return (
    <section class="timeline">
      <h2>Timeline<span class="count">last {kWindow_s} s</span>
        <span class="grow" />
        <span class="key"><i class="solid" /> runs</span><span class="key"><i class="hatched" /> waits</span>
      </h2>
      <canvas ref={canvas} role="img" aria-label="What each arm did in the last minute" />
    </section>
  );
}

interface Lane { name: string; colour: string; top: number; height: number }
interface Sheet { g: CanvasRenderingContext2D; width: number; height: number; now_s: number; x(t_s: number): number }

function draw_timeline(canvas: HTMLCanvasElement, store: Store): void {
  const sheet = fit(canvas, store.t_s);
  if (!sheet) return;
  draw_axis(sheet);
  const names = [...store.arms.keys()];
  const lane_height = Math.min(58, (sheet.height - kAxis_px) / Math.max(1, names.length));
  const jobs = store.all_jobs();
  names.forEach((name, i) => {
    const lane: Lane = { name, colour: arm_colour(names, name), top: i * lane_height, height: lane_height };
    draw_lane(sheet, lane, jobs.filter((job) => job.arms.includes(name)));
  });
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
  return { g, width, height, now_s, x: (t_s) => width - kRight_px - (now_s - t_s) * per_s };
}

function draw_axis({ g, width, height, now_s, x }: Sheet): void {
  g.font = '10.5px "Inter Variable", system-ui, sans-serif';
  g.textAlign = 'center';
  g.textBaseline = 'alphabetic';
  g.lineWidth = 1;
  for (let t_s = Math.ceil((now_s - kWindow_s) / 10) * 10; t_s <= now_s; t_s += 10) {
    if (t_s < 0) continue;
    const at = Math.round(x(t_s)) + 0.5;
    g.strokeStyle = '#1f2732';
    line(g, at, 0, at, height - kAxis_px);
    g.fillStyle = '#6b7787';
    const label = `${Math.floor(t_s / 60)}:${String(t_s % 60).padStart(2, '0')}`;
    if (at > kLeft_px + 8 && at < width - 18) g.fillText(label, at, height - 5);
  }
  g.strokeStyle = '#3a4656';
  line(g, Math.round(x(now_s)) + 0.5, 0, Math.round(x(now_s)) + 0.5, height - kAxis_px);
}

function draw_lane(sheet: Sheet, lane: Lane, jobs: Job[]): void {
  const { g, width, now_s, x } = sheet;
  const from_s = now_s - kWindow_s;
  const wait_height = Math.max(4, Math.round(lane.height * 0.16));
  const bar_top = lane.top + 5;
  const bar_height = lane.height - wait_height - 12;
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
