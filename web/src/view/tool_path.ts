// The path that an arm's tool has taken in the last seconds, as a line that fades with age.

import * as THREE from 'three';
import type { Arm } from '../server/messages';
import { arm_color, ink } from '../state/palette';
import type { Robots } from './robots';

const kPoints = 120;
const kLeastStep_m = 0.004;
const kLasts_s = 6;

export class ToolPath {
  readonly line: THREE.Line;
  private readonly passed_: { t_s: number; p_W: THREE.Vector3 }[] = [];

  constructor() {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * kPoints), 3));
    geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(4 * kPoints), 4));
    this.line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false, toneMapped: false }));
    this.line.frustumCulled = false;
  }

  /** Removes the line, because another time or another cell is shown. */
  clear(): void {
    this.passed_.length = 0;
    this.line.geometry.setDrawRange(0, 0);
  }

  /**
   * Adds the tool's position in the world frame at a cell time. The line is drawn in the arm's
   * color.
   */
  pass(t_s: number, p_W: THREE.Vector3, color: THREE.Color): void {
    const last = this.passed_.at(-1);
    if (last && t_s < last.t_s) this.clear();
    if (!last || last.p_W.distanceTo(p_W) > kLeastStep_m) this.passed_.push({ t_s, p_W: p_W.clone() });
    while (this.passed_.length > kPoints || (this.passed_[0] && this.passed_[0].t_s < t_s - kLasts_s)) this.passed_.shift();
    this.draw(t_s, color);
  }

  private draw(t_s: number, color: THREE.Color): void {
    const { geometry } = this.line;
    const position = geometry.getAttribute('position');
    const shade = geometry.getAttribute('color');
    this.passed_.forEach((passed, i) => {
      position.setXYZ(i, passed.p_W.x, passed.p_W.y, passed.p_W.z);
      shade.setXYZW(i, color.r, color.g, color.b, 1 - (t_s - passed.t_s) / kLasts_s);
    });
    position.needsUpdate = true;
    shade.needsUpdate = true;
    geometry.setDrawRange(0, this.passed_.length);
  }
}

/** The paths that the tools of all arms have taken in the last seconds. */
export class ToolPaths {
  readonly group = new THREE.Group();
  private readonly paths_ = new Map<string, ToolPath>();

  clear(): void {
    for (const path of this.paths_.values()) path.clear();
  }

  /** Adds the present tool positions of all arms, at a cell time. */
  follow(robots: Robots, arms: ReadonlyMap<string, Arm>, t_s: number): void {
    const names = [...arms.keys()];
    for (const arm of arms.values()) {
      const p_W = robots.get(arm.robot)?.tool(arm.name);
      if (p_W) this.pass(arm.name, t_s, p_W, ink(arm_color(names, arm.name)));
    }
  }

  private pass(arm: string, t_s: number, p_W: THREE.Vector3, color: string): void {
    let path = this.paths_.get(arm);
    if (!path) {
      path = new ToolPath();
      this.paths_.set(arm, path);
      this.group.add(path.line);
    }
    path.pass(t_s, p_W, new THREE.Color(color));
  }
}
