// The pairs that the monitor finds closest, each as a line between the two bodies with its distance. The
// figure is what the monitor measured; the line joins the closest points of what is drawn.

import * as THREE from 'three';
import type { Clearance } from '../server/messages';
import { ink } from '../state/palette';
import { millimetres } from '../wording';
import { FinishedMesh } from './finish';
import { closest_points, corners_of, type Surface } from './closest';
import { stacked } from './stacking';

const kShown_m = 0.4;
// What stands on a table is always close to it: an object is told of when an arm comes near its limit.
const kNear = 3;

// As labels are drawn (layout.css).
const kLabel_px = 19;
const kLabelGap_px = 2;

interface Line { line: THREE.Line; element: HTMLElement; middle: THREE.Vector3; width_px: number }

export class Distances {
  readonly group = new THREE.Group();
  private readonly lines_: Line[] = [];
  private readonly corners_ = new WeakMap<THREE.BufferGeometry, Float32Array>();

  /** `find`: what is drawn of a link or an object of this name. */
  constructor(private readonly host_: HTMLElement, private readonly find_: (body: string) => THREE.Mesh | null) {}

  /**
   * Bodies stand where they are drawn; nothing is shown of what is farther apart, and of so many only the closest, or
   * what comes near its limit. Answers whether other lines are seen.
   */
  show(pairs: readonly Clearance[], limit_m: number, most = Infinity): boolean {
    const before = this.seen();
    const near = pairs.filter(({ m, arms }) => m < (arms.length > 1 ? kShown_m : kNear * limit_m))
      .sort((a, b) => a.m - b.m).filter(({ m }, i) => i < most || m < kNear * limit_m);
    near.forEach((pair, i) => this.draw(this.line(i), pair, limit_m));
    for (const line of this.lines_.slice(near.length)) hide(line);
    return this.seen() !== before;
  }

  /** Labels follow their lines, below each other where they would lie on one; the function says where a point stands, px from the view's top left. */
  place(to_page: (p_W: THREE.Vector3) => { x: number; y: number } | null): void {
    const found = this.lines_.flatMap((shown) => {
      const p = shown.line.visible ? to_page(shown.middle) : null;
      shown.element.hidden = p === null;
      return p ? [{ shown, p }] : [];
    });
    for (const { shown } of found) shown.width_px ||= shown.element.offsetWidth;
    const y = stacked(found.map(({ shown, p }) => ({ ...p, width_px: shown.width_px })), kLabel_px, kLabelGap_px);
    found.forEach(({ shown, p }, i) => { shown.element.style.transform = `translate(${p.x.toFixed(1)}px, ${(y[i] ?? p.y).toFixed(1)}px)`; });
  }

  clear(): void {
    for (const { line, element } of this.lines_.splice(0)) {
      element.remove();
      line.geometry.dispose();
      this.group.remove(line);
    }
  }

  private draw(shown: Line, { links, m }: Clearance, limit_m: number): void {
    const [a, b] = [this.surface(links[0]), this.surface(links[1])];
    const points = a && b ? closest_points(a, b) : null;
    if (!points) return hide(shown);
    const level = m < limit_m ? 'low' : m < kNear * limit_m ? 'near' : '';
    shown.line.visible = true;
    shown.line.geometry.setFromPoints(points);
    (shown.line.material as THREE.LineBasicMaterial).color.set(ink(level === 'low' ? '--red' : level === 'near' ? '--amber' : '--text'));
    shown.middle.copy(points[0]).add(points[1]).multiplyScalar(0.5);
    const figure = millimetres(m);
    if (figure.length !== shown.element.textContent?.length) shown.width_px = 0;  // measured when it is placed
    shown.element.textContent = figure;
    shown.element.className = `distance-label ${level}`;
  }

  private seen(): string {
    return this.lines_.map(({ line }) => (line.visible ? 1 : 0)).join('');
  }

  private line(i: number): Line {
    const known = this.lines_[i];
    if (known) return known;
    const material = new THREE.LineBasicMaterial({ depthTest: false, transparent: true, toneMapped: false });
    const line = new THREE.Line(new THREE.BufferGeometry(), material);
    line.renderOrder = 2;
    line.frustumCulled = false;
    const made = { line, element: document.createElement('div'), middle: new THREE.Vector3(), width_px: 0 };
    hide(made);  // until it is placed
    this.group.add(line);
    this.host_.append(made.element);
    this.lines_.push(made);
    return made;
  }

  private surface(body: string): Surface | null {
    const mesh = this.find_(body);
    if (!mesh) return null;
    // One line, however finely the mesh is drawn now.
    const geometry = mesh instanceof FinishedMesh ? mesh.fine.geometry : mesh.geometry;
    let corners = this.corners_.get(geometry);
    if (!corners) {
      corners = corners_of(geometry);
      this.corners_.set(geometry, corners);
    }
    mesh.updateWorldMatrix(true, false);
    return { corners, X_W: mesh.matrixWorld };
  }
}

function hide({ line, element }: Line): void {
  line.visible = false;
  element.hidden = true;
}
