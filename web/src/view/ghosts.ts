// Arms as they would stand: translucent, each in its own colour, over the cell as it is.

import * as THREE from 'three';
import type { Cell } from '../server/messages';
import { FinishedMesh, quick_material } from './finish';
import { dispose } from './shapes';
import { RobotModel } from './robot';
import type { Surfaces } from './surfaces';

const kPreview = 0.42;

export class Ghosts {
  readonly group = new THREE.Group();
  private readonly models_ = new Map<string, RobotModel>();

  constructor(private readonly opacity_ = kPreview) {}

  /** The robots that these joints belong to stand as told; null: no ghost. A robot is built when it is first asked for. */
  show(q: Readonly<Record<string, number>> | null, now: Readonly<Record<string, number>>, cell: Cell, surfaces: Surfaces, colour: (arm: string) => string): void {
    for (const model of this.models_.values()) model.root.visible = false;
    if (!q) return;
    for (const robot of cell.robots) {
      const arm = robot.arms.find(({ joints }) => joints.some((joint) => joint in q));
      if (!arm) continue;
      let model = this.models_.get(robot.name);
      if (!model) {
        model = new RobotModel(robot, surfaces);
        this.models_.set(robot.name, model);
        paint(model.root, colour(arm.name), this.opacity_);
        this.group.add(model.root);
      }
      model.root.visible = true;
      model.set_q({ ...now, ...q });
    }
  }

  /** Another cell has other robots. */
  clear(): void {
    dispose(this.group);
    this.group.clear();
    this.models_.clear();
  }
}

function paint(root: THREE.Object3D, colour: string, opacity: number): void {
  const skin = new THREE.MeshStandardMaterial({ color: colour, transparent: true, opacity, depthWrite: false, roughness: 0.6, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 4 });
  const quick_skin = quick_material(skin);
  root.traverse((node) => {
    if (!(node instanceof THREE.Mesh)) return;
    if (node.geometry instanceof THREE.RingGeometry) node.visible = false;
    if (node instanceof FinishedMesh) node.paint(skin, quick_skin);
    node.castShadow = false;
    node.receiveShadow = false;
  });
}
