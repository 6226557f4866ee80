// Draws the monitor's closest pairs, each as a line with its distance. The distance is the
// monitor's measurement. The line joins the closest points of the drawn meshes.

import * as THREE from 'three';
import type { Clearance } from '../server/messages';
import { ink } from '../state/palette';
import { millimeters } from '../wording';
import { FinishedMesh } from './finish';
import { closest_points, corners_of, type Surface } from './closest';
import { stacked } from './stacking';

const kShown_m = 0.4;
// Pairs with objects are shown only if their distance is below this multiple of the limit. Objects
// on a table, for example, are always close to it.
const kNear = 3;

// The height of a label, as set in layout.css.
const kLabel_px = 19;
const kLabelGap_px = 2;

interface Line { line: THREE.Line; element: HTMLElement; middle: THREE.Vector3; width_px: number }

export class Distances {
  readonly group = new THREE.Group();
  private readonly lines_: Line[] = [];
  private readonly corners_ = new WeakMap<THREE.BufferGeometry, Float32Array>();

  /** `find` returns the drawn mesh of a link or an object, or null. */
  constructor(private readonly host_: HTMLElement, private readonly find_: (body: string) => THREE.Mesh | null) {}

  /**
   * Shows the close pairs: the `most` closest, and all that are near the limit. Links and objects
   * must already be at their drawn positions. Returns true if the visible lines changed.
   */
  show(pairs: readonly Clearance[], limit_m: number, most = Infinity): boolean {
    const before = this.seen();
    const near = pairs.filter(({ m, arms }) => m < (arms.length > 1 ? kShown_m : kNear * limit_m))
      .sort((a, b) => a.m - b.m).filter(({ m }, i) => i < most || m < kNear * limit_m);
    near.forEach((pair, i) => this.draw(this.line(i), pair, limit_m));
    for (const line of this.lines_.slice(near.length)) hide(line);
    return this.seen() !== before;
  }

  /**
   * Places the labels at their lines. Labels that would overlap are stacked. `to_page` returns the
   * position of a point of the world frame, px from the view's top left.
   */
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
    const figure = millimeters(m);
    if (figure.length !== shown.element.textContent?.length) shown.width_px = 0;  // place() then measures the label again
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
    hide(made);  // hidden until placed
    this.group.add(line);
    this.host_.append(made.element);
    this.lines_.push(made);
    return made;
  }

  private surface(body: string): Surface | null {
    const mesh = this.find_(body);
    if (!mesh) return null;
    // Always the fine mesh, so that the line is the same at every level of detail.
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
