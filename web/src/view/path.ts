// The rest of an arm's tool path, with markers at equal time steps. Markers up to the granted
// authority are bright, later markers are faint. A ring marks the end of the authority.

import * as THREE from 'three';

const kBead_s = 0.05;
const kMostBeads = 240;
const kGranted_px = 6;
const kBeyond_px = 3.5;
const kMark_px = 13;

export interface Stretch { from_s: number; granted_s: number }

export class Path {
  readonly group = new THREE.Group();
  private readonly geometry_ = new THREE.BufferGeometry();
  private readonly mark_geometry_ = new THREE.BufferGeometry();
  private readonly line_: THREE.Line;
  private readonly granted_: THREE.Points;
  private readonly beyond_: THREE.Points;
  private readonly mark_: THREE.Points;

  /**
   * `points` are the positions of the tool in the world frame, at equal time steps over the whole
   * motion.
   */
  constructor(private readonly points_: readonly THREE.Vector3[], private readonly duration_s_: number) {
    this.geometry_.setFromPoints([...points_]);
    this.mark_geometry_.setFromPoints([points_[0] ?? new THREE.Vector3()]);
    this.line_ = new THREE.Line(this.geometry_, new THREE.LineBasicMaterial({ transparent: true, opacity: 0.45, depthWrite: false, toneMapped: false }));
    this.granted_ = new THREE.Points(this.geometry_, beads(kGranted_px, 1));
    this.beyond_ = new THREE.Points(this.geometry_, beads(kBeyond_px, 0.6));
    this.mark_ = new THREE.Points(this.mark_geometry_, beads(kMark_px, 1, true));
    this.group.add(this.line_, this.granted_, this.beyond_, this.mark_);
    for (const part of this.group.children) part.frustumCulled = false;
  }

  paint(color: string): void {
    for (const part of [this.line_, this.granted_, this.beyond_, this.mark_]) (part.material as THREE.PointsMaterial).color.set(color);
  }

  /**
   * Shows the path from `from_s` to its end, bright up to `granted_s`. Both are in seconds of the
   * trajectory.
   */
  show({ from_s, granted_s }: Stretch): void {
    const count = this.points_.length;
    const index = (t_s: number) => Math.min(count, Math.max(0, Math.ceil((t_s / this.duration_s_) * (count - 1))));
    const from = index(from_s);
    const granted = Math.max(from, index(granted_s) + (granted_s >= this.duration_s_ ? 1 : 0));
    this.geometry_.setDrawRange(from, count - from);
    const within = granted > from;
    const is_limited = granted_s < this.duration_s_ - 1e-3 && within;
    this.granted_.visible = within;
    // All parts share one buffer. The range to draw is set before each part is drawn.
    this.granted_.onBeforeRender = () => this.geometry_.setDrawRange(from, granted - from);
    this.beyond_.onBeforeRender = () => this.geometry_.setDrawRange(granted, count - granted);
    this.line_.onBeforeRender = () => this.geometry_.setDrawRange(from, count - from);
    this.mark_.visible = is_limited;
    const end = this.points_[Math.min(count - 1, granted)];
    if (is_limited && end) {
      this.mark_geometry_.getAttribute('position').setXYZ(0, end.x, end.y, end.z);
      this.mark_geometry_.getAttribute('position').needsUpdate = true;
    }
  }

  close(): void {
    this.geometry_.dispose();
    this.mark_geometry_.dispose();
    for (const part of [this.line_, this.granted_, this.beyond_, this.mark_]) (part.material as THREE.Material).dispose();
  }
}

/** Returns the number of markers on the path of a motion. */
export function beads_of(duration_s: number): number {
  return Math.min(kMostBeads, Math.max(2, Math.ceil(duration_s / kBead_s) + 1));
}

const textures = new Map<boolean, THREE.Texture>();

function beads(size: number, opacity: number, ring = false): THREE.PointsMaterial {
  let texture = textures.get(ring);
  if (!texture) {
    texture = disc(ring);
    textures.set(ring, texture);
  }
  return new THREE.PointsMaterial({ size, sizeAttenuation: false, map: texture, alphaTest: 0.3, opacity, transparent: true, depthWrite: false, toneMapped: false });
}

function disc(ring: boolean): THREE.Texture {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 32;
  const g = canvas.getContext('2d');
  if (g) {
    g.fillStyle = g.strokeStyle = '#fff';
    g.lineWidth = 7;
    g.beginPath();
    g.arc(16, 16, ring ? 11 : 15, 0, 2 * Math.PI);
    if (ring) g.stroke();
    else g.fill();
  }
  return new THREE.CanvasTexture(canvas);
}
