// The drawn robots of a cell.

import * as THREE from 'three';
import type { Arm, Cell } from '../server/messages';
import { RobotModel } from './robot';
import { dispose } from './shapes';
import type { Surfaces } from './surfaces';

export class Robots {
  readonly group = new THREE.Group();
  private readonly models_ = new Map<string, RobotModel>();

  /**
   * Adds the robots of a cell. A robot that cannot be drawn is reported in the console and left
   * out.
   */
  add(cell: Cell, surfaces: Surfaces): void {
    for (const robot of cell.robots) {
      try {
        const model = new RobotModel(robot, surfaces);
        this.models_.set(robot.name, model);
        this.group.add(model.root);
      } catch (error) {
        console.warn(`robot ${robot.name} cannot be drawn:`, error);
      }
    }
  }

  clear(): void {
    for (const robot of this.models_.values()) dispose(robot.root);
    this.group.clear();
    this.models_.clear();
  }

  get size(): number {
    return this.models_.size;
  }

  get(name: string | undefined): RobotModel | null {
    return this.models_.get(name ?? '') ?? null;
  }

  /** Returns true if any joint moved visibly. */
  set_q(q: Readonly<Record<string, number>>): boolean {
    let moved = false;
    for (const robot of this.models_.values()) moved = robot.set_q(q) || moved;
    return moved;
  }

  /** Moves all robots to their home positions. */
  set_home({ robots }: Cell): void {
    const arms = robots.flatMap((robot) => robot.arms);
    this.set_q(Object.fromEntries(arms.flatMap(({ joints, home }) => joints.map((joint, i) => [joint, home[i] ?? 0] as const))));
  }

  /** Returns the arm's base point in the world frame, or null if the arm is not drawn. */
  foot_of(arm: Pick<Arm, 'name' | 'robot'> | undefined): THREE.Vector3 | null {
    const robot = this.get(arm?.robot);
    return arm && robot?.root.visible && this.group.visible ? robot.foot(arm.name) : null;
  }

  /** Shows or hides a robot. For tests and debugging. */
  set_visible(name: string, visible: boolean): void {
    const robot = this.get(name);
    if (!robot) throw new Error(`no robot "${name}"`);
    robot.root.visible = visible;
  }

  show_lit(arms: readonly string[]): void {
    for (const robot of this.models_.values()) robot.show_lit(arms);
  }

  /** Returns the drawn mesh of a link, or null if its robot is hidden. */
  skin_of(link: string): THREE.Mesh | null {
    for (const robot of this.models_.values()) {
      const skin = robot.root.visible ? robot.skin_of(link) : null;
      if (skin) return skin;
    }
    return null;
  }

  /** Returns the arm to which a drawn object belongs, or null. */
  arm_of(node: THREE.Object3D): string | null {
    for (const robot of this.models_.values()) {
      const arm = robot.arm_of(node);
      if (arm !== null) return arm;
    }
    return null;
  }
}
