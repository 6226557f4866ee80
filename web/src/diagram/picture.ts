// Draws a diagram on two stacked canvases: static cells below, moving parts above. The progress of
// job A runs across, of job B up, in seconds of each trajectory.

import type { Evidence, Point } from './reading';
import type { Diagram, DiagramLayer, DiagramContact } from '../server/messages';
import { ink, kCellColors, kUndecidedStripes } from '../state/palette';
import { millimeters, short_id } from '../wording';
import { kText } from '../strings';

export interface Scene {
  diagram: Diagram;
  layer: DiagramLayer;
  now: Point;
  /** The predicted progress of both jobs. Empty if there is no prediction. */
  prediction: Point[];
  trail: Point[];
  contact: DiagramContact | null;
  evidence: Evidence | null;
  /** How far each job may go, whatever the other job does. Null if no job has been told to move. */
  authority: Point | null;
  /** The point under the pointer. */
  pointed: Point | null;
  colors: { a: string; b: string };
}

const kLeft_px = 40;
const kBottom_px = 36;
const kTop_px = 10;
const kRight_px = 12;
const kTick_px = 56;
const kNarrowest = 3;  // if one job is this many times longer than the other, each axis has its own scale
const kStripes_px = 6;
const kInk = '#0c1118';
const kPlan = '#10161f';
// Dash patterns of the prediction, px: before the first contact, and beyond it.
const kGoesOn = [7, 6];
const kBeyond = [1, 12];

interface Sheet { width: number; height: number; x(a_s: number): number; y(b_s: number): number }

export class DiagramPicture {
  private readonly cells_ = document.createElement('canvas');
  private readonly moving_ = document.createElement('canvas');
  private readonly observer_: ResizeObserver;
  private drawn_ = '';

  constructor(private readonly host_: HTMLElement, private readonly scene_: () => Scene | null) {
    host_.replaceChildren(this.cells_, this.moving_);
    this.observer_ = new ResizeObserver(() => this.draw());
    this.observer_.observe(host_);
    this.draw();
  }

  close(): void {
    this.observer_.disconnect();
    this.host_.replaceChildren();
  }

  /**
   * Returns the times of both jobs at a point of the picture. The point is in px from the top left.
   * Null if the point is outside of the diagram.
   */
  at(x_px: number, y_px: number): Point | null {
    const scene = this.scene_();
    if (!scene) return null;
    const { a, b } = scene.diagram;
    const sheet = sheet_of(scene.diagram, this.host_.clientWidth, this.host_.clientHeight);
    const [left, right, bottom, top] = [sheet.x(0), sheet.x(a.duration_s), sheet.y(0), sheet.y(b.duration_s)];
    if (x_px < left || x_px > right || y_px < top || y_px > bottom) return null;
    return { a_s: (a.duration_s * (x_px - left)) / (right - left), b_s: (b.duration_s * (bottom - y_px)) / (bottom - top) };
  }

  draw(): void {
    const scene = this.scene_();
    const { clientWidth: width, clientHeight: height } = this.host_;
    if (!scene || width === 0 || height === 0) return;
    const sheet = sheet_of(scene.diagram, width, height);
    const size = `${width} ${height} ${window.devicePixelRatio}`;
    if (size !== this.drawn_) {
      this.drawn_ = size;
      const g = fit(this.cells_, width, height);
      if (g) {
        draw_cells(g, sheet, scene);
        draw_axes(g, sheet, scene);
      }
    }
    const g = fit(this.moving_, width, height);
    if (g) draw_moving(g, sheet, scene);
  }
}

/**
 * Returns the geometry of the picture. Both axes have one scale, so that equal progress is a line
 * of 45 degrees. If one job is much longer, each axis has its own scale.
 */
function sheet_of({ a, b }: Diagram, width: number, height: number): Sheet {
  const room = { x: width - kLeft_px - kRight_px, y: height - kTop_px - kBottom_px };
  let per_s = { x: room.x / a.duration_s, y: room.y / b.duration_s };
  const ratio = a.duration_s / b.duration_s;
  if (ratio < kNarrowest && ratio > 1 / kNarrowest) {
    const least = Math.min(per_s.x, per_s.y);
    per_s = { x: least, y: least };
  }
  const left = kLeft_px + Math.max(0, (room.x - per_s.x * a.duration_s) / 2);
  const bottom = height - kBottom_px;
  return {
    width, height,
    x: (a_s) => left + a_s * per_s.x,
    y: (b_s) => bottom - b_s * per_s.y,
  };
}

function fit(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D | null {
  const ratio = Math.min(2, window.devicePixelRatio);
  const pixels = { width: Math.round(width * ratio), height: Math.round(height * ratio) };
  if (canvas.width !== pixels.width || canvas.height !== pixels.height) Object.assign(canvas, pixels);
  const g = canvas.getContext('2d');
  g?.setTransform(ratio, 0, 0, ratio, 0, 0);
  g?.clearRect(0, 0, width, height);
  return g;
}

function draw_cells(g: CanvasRenderingContext2D, sheet: Sheet, { layer }: Scene): void {
  const [edges, undecided] = [new Path2D(), new Path2D()];
  for (const { state, a_s, b_s } of layer.cells ?? []) {
    const left = sheet.x(a_s[0]);
    const top = sheet.y(b_s[1]);
    const width = sheet.x(a_s[1]) - left;
    const height = sheet.y(b_s[0]) - top;
    g.fillStyle = kCellColors[state];
    // Neighbors overlap slightly, so that no gaps show between cells.
    g.fillRect(left, top, width + 0.4, height + 0.4);
    if (state === 'undecided') undecided.rect(left, top, width + 0.4, height + 0.4);
    if (width > 3 && height > 3) edges.rect(left, top, width, height);
  }
  stripe(g, sheet, undecided);
  g.strokeStyle = '#0b10162e';
  g.lineWidth = 0.5;
  g.stroke(edges);
}

function stripe(g: CanvasRenderingContext2D, { width, height }: Sheet, where: Path2D): void {
  g.save();
  g.clip(where);
  g.strokeStyle = kUndecidedStripes;
  g.lineWidth = 1.2;
  g.beginPath();
  for (let at = -height; at < width; at += kStripes_px) {
    g.moveTo(at, height);
    g.lineTo(at + height, 0);
  }
  g.stroke();
  g.restore();
}

function draw_axes(g: CanvasRenderingContext2D, sheet: Sheet, { diagram, colors }: Scene): void {
  const { a, b } = diagram;
  const [left, right, bottom, top] = [sheet.x(0), sheet.x(a.duration_s), sheet.y(0), sheet.y(b.duration_s)];
  g.strokeStyle = ink('--line-strong');
  g.lineWidth = 1;
  g.strokeRect(left - 0.5, top - 0.5, right - left + 1, bottom - top + 1);
  g.font = '10.5px "Inter Variable", system-ui, sans-serif';
  g.fillStyle = ink('--dim');
  g.textBaseline = 'top';
  g.textAlign = 'center';
  for (const t_s of ticks(a.duration_s, right - left)) g.fillText(figure(t_s), sheet.x(t_s), bottom + 5);
  g.textAlign = 'right';
  g.textBaseline = 'middle';
  for (const t_s of ticks(b.duration_s, bottom - top)) g.fillText(figure(t_s), left - 6, sheet.y(t_s));
  g.font = '600 11.5px "Inter Variable", system-ui, sans-serif';
  g.textAlign = 'center';
  g.textBaseline = 'alphabetic';
  g.fillStyle = colors.a;
  g.fillText(kText.diagram.axis(short_id(a.id)), (left + right) / 2, sheet.height - 4);
  g.save();
  g.translate(left - 28, (top + bottom) / 2);
  g.rotate(-Math.PI / 2);
  g.fillStyle = colors.b;
  g.fillText(kText.diagram.axis(short_id(b.id)), 0, 0);
  g.restore();
}

function ticks(duration_s: number, length_px: number): number[] {
  const wanted_s = duration_s / Math.max(1, length_px / kTick_px);
  const power = 10 ** Math.floor(Math.log10(wanted_s));
  const step_s = [1, 2, 5, 10].map((n) => n * power).find((s) => s >= wanted_s) ?? wanted_s;
  return Array.from({ length: Math.floor(duration_s / step_s + 1e-9) + 1 }, (_, i) => i * step_s);
}

function figure(t_s: number): string {
  return String(Number(t_s.toPrecision(6)));
}

function draw_moving(g: CanvasRenderingContext2D, sheet: Sheet, scene: Scene): void {
  const { now, prediction, trail, contact, evidence, colors } = scene;
  g.lineJoin = 'round';
  g.lineCap = 'round';
  g.setLineDash([]);
  const [x, y] = [sheet.x(now.a_s), sheet.y(now.b_s)];
  // Lines from the current progress to both axes.
  guide(g, [x, y], [x, sheet.y(0)], colors.a);
  guide(g, [x, y], [sheet.x(0), y], colors.b);
  draw_authority(g, sheet, scene);
  polyline(g, sheet, trail, kInk, 2.5);
  if (prediction.length > 0) {
    // Dashed, because the prediction may not happen.
    g.setLineDash(kBeyond);
    polyline(g, sheet, prediction, kPlan, 1.8);
    g.setLineDash(kGoesOn);
    polyline(g, sheet, contact ? up_to(prediction, contact) : prediction, kPlan, 1.8);
    g.setLineDash([]);
  }
  if (evidence) mark(g, sheet, evidence);
  if (scene.pointed) ring(g, sheet.x(scene.pointed.a_s), sheet.y(scene.pointed.b_s));
  if (contact) cross(g, sheet.x(contact.a_s), sheet.y(contact.b_s));
  g.beginPath();
  g.arc(x, y, 5.5, 0, 2 * Math.PI);
  g.fillStyle = '#ffffff';
  g.fill();
  g.lineWidth = 2.5;
  g.strokeStyle = kInk;
  g.stroke();
}

/** Draws the rectangle up to which both jobs have authority. It contains no conflict. */
function draw_authority(g: CanvasRenderingContext2D, sheet: Sheet, { now, authority }: Scene): void {
  if (!authority) return;
  const [left, bottom] = [sheet.x(now.a_s), sheet.y(now.b_s)];
  const [right, top] = [sheet.x(Math.max(now.a_s, authority.a_s)), sheet.y(Math.max(now.b_s, authority.b_s))];
  g.fillStyle = '#1a7f5a3d';
  g.strokeStyle = '#0d5a3e';
  g.lineWidth = 1.6;
  g.fillRect(left, top, right - left, bottom - top);
  g.strokeRect(left, top, right - left, bottom - top);
}

function ring(g: CanvasRenderingContext2D, x: number, y: number): void {
  g.beginPath();
  g.arc(x, y, 7, 0, 2 * Math.PI);
  g.strokeStyle = kInk;
  g.lineWidth = 2;
  g.stroke();
}

function up_to(prediction: Point[], contact: DiagramContact): Point[] {
  return [...prediction.filter((point) => point.a_s <= contact.a_s && point.b_s <= contact.b_s), contact];
}

function polyline(g: CanvasRenderingContext2D, sheet: Sheet, points: Point[], color: string, width: number): void {
  g.beginPath();
  points.forEach((point, i) => (i === 0 ? g.moveTo : g.lineTo).call(g, sheet.x(point.a_s), sheet.y(point.b_s)));
  g.strokeStyle = color;
  g.lineWidth = width;
  g.stroke();
}

/** Marks the place of the conflict that the server named, with its clearance. */
function mark(g: CanvasRenderingContext2D, sheet: Sheet, evidence: Evidence): void {
  const [x, y] = [sheet.x(evidence.a_s), sheet.y(evidence.b_s)];
  g.beginPath();
  g.arc(x, y, 6, 0, 2 * Math.PI);
  g.strokeStyle = '#ffffff';
  g.lineWidth = 2;
  g.stroke();
  const { clearance_m } = evidence.wait;
  if (clearance_m === null) return;
  const text = clearance_m <= 0 ? kText.diagram.touch : millimeters(clearance_m);
  g.font = '600 11.5px "Inter Variable", system-ui, sans-serif';
  const width = g.measureText(text).width + 12;
  const left = Math.max(sheet.x(0) + 4, x - width - 12);
  const top = Math.max(kTop_px + 4, y - 24);
  g.fillStyle = '#0c1118d8';
  g.beginPath();
  g.roundRect(left, top, width, 19, 5);
  g.fill();
  g.fillStyle = '#ffffff';
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  g.fillText(text, left + 6, top + 10);
}

function cross(g: CanvasRenderingContext2D, x: number, y: number): void {
  g.beginPath();
  for (const [dx, dy] of [[1, 1], [1, -1]] as const) {
    g.moveTo(x - 4 * dx, y - 4 * dy);
    g.lineTo(x + 4 * dx, y + 4 * dy);
  }
  g.strokeStyle = kInk;
  g.lineWidth = 2;
  g.stroke();
}

function guide(g: CanvasRenderingContext2D, from: [number, number], to: [number, number], color: string): void {
  g.beginPath();
  g.moveTo(...from);
  g.lineTo(...to);
  g.strokeStyle = color;
  g.lineWidth = 2;
  g.stroke();
}
