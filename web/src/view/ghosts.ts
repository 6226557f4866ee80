// Ghosts: translucent robots in the colors of their arms, at planned positions.

import * as THREE from 'three';
import type { Cell, CellRobot } from '../server/messages';
import { FinishedMesh, quick_material } from './finish';
import { dispose } from './shapes';
import { RobotModel } from './robot';
import type { Surfaces } from './surfaces';

const kPreview = 0.42;

type Model = Pick<RobotModel, 'set_q'> & { root: THREE.Object3D };
/**
 * `q` are the joint positions of the ghosts, or null. `now` are the measured positions, for all
 * other joints.
 */
export interface Poses { q: Readonly<Record<string, number>> | null; now: Readonly<Record<string, number>> }

export class Ghosts {
  readonly group = new THREE.Group();
  private readonly models_ = new Map<string, Model>();

  constructor(private readonly opacity_ = kPreview, private readonly build_: (robot: CellRobot, surfaces: Surfaces) => Model = (robot, surfaces) => new RobotModel(robot, surfaces)) {}

  /**
   * Shows a ghost of each robot that has a joint in `q`. Shows none if `q` is null. A robot is
   * built when it is first shown, one in each call, because building is slow. Returns false while
   * robots are still to be built.
   */
  show({ q, now }: Poses, cell: Cell, surfaces: Surfaces, color: (arm: string) => string): boolean {
    for (const model of this.models_.values()) model.root.visible = false;
    let built = 0;
    for (const robot of q ? cell.robots : []) {
      const arm = robot.arms.find(({ joints }) => joints.some((joint) => joint in (q ?? {})));
      if (!arm) continue;
      const known = this.models_.get(robot.name);
      if (!known && ++built > 1) return false;
      const model = known ?? this.add(robot, surfaces, color(arm.name));
      model.root.visible = true;
      model.set_q({ ...now, ...q });
    }
    return true;
  }

  /** The number of built robots. */
  get count(): number {
    return this.models_.size;
  }

  private add(robot: CellRobot, surfaces: Surfaces, color: string): Model {
    const model = this.build_(robot, surfaces);
    this.models_.set(robot.name, model);
    paint(model.root, color, this.opacity_);
    this.group.add(model.root);
    return model;
  }

  /** Discards all ghosts, because another cell or theme is shown. */
  clear(): void {
    dispose(this.group);
    this.group.clear();
    this.models_.clear();
  }
}

function paint(root: THREE.Object3D, color: string, opacity: number): void {
  const skin = new THREE.MeshStandardMaterial({ color: color, transparent: true, opacity, depthWrite: false, roughness: 0.6, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 4 });
  const quick_skin = quick_material(skin);
  root.traverse((node) => {
    if (!(node instanceof THREE.Mesh)) return;
    if (node.geometry instanceof THREE.RingGeometry) node.visible = false;
    if (node instanceof FinishedMesh) node.paint(skin, quick_skin);
    node.castShadow = false;
    node.receiveShadow = false;
  });
}
