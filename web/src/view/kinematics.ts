// Computes the forward kinematics of a robot without drawing it. Used for predicted paths.

import * as THREE from 'three';
import URDFLoader, { type URDFRobot } from 'urdf-loader';
import type { CellArm, CellRobot } from '../server/messages';
import { place } from './shapes';

export class Kinematics {
  readonly root: URDFRobot;
  readonly name: string;
  private readonly prefix_: string;
  private readonly arms_: readonly CellArm[];

  /** Throws if the robot's text is not a URDF. */
  constructor(robot: CellRobot) {
    const loader = new URDFLoader();
    loader.parseVisual = false;
    loader.parseCollision = false;
    this.root = loader.parse(robot.urdf);
    for (const joint of Object.values(this.root.joints)) joint.ignoreLimits = true;
    place(this.root, robot.base.xyz, robot.base.rpy);
    this.name = robot.name;
    this.prefix_ = robot.prefix;
    this.arms_ = robot.arms;
  }

  set_q(q: Readonly<Record<string, number>>): void {
    for (const [key] of Object.entries(this.root.joints)) {
      const value = q[this.prefix_ + key];
      if (value !== undefined) this.root.setJointValue(key, value);
    }
    this.root.updateMatrixWorld(true);
  }

  /**
   * Returns the tool's position in the world frame: the middle between the fingers, or the last
   * joint if the arm has no gripper.
   */
  tool(arm: string): THREE.Vector3 | null {
    return tool_of(this.root, this.prefix_, this.arms_.find((one) => one.name === arm));
  }

  /** Returns each link of the robot with its name in the cell, which is the prefix and the URDF name. */
  links(): [name: string, link: THREE.Object3D][] {
    return Object.entries(this.root.links).map(([name, link]) => [this.prefix_ + name, link]);
  }
}

export function tool_of(root: URDFRobot, prefix: string, arm: CellArm | undefined): THREE.Vector3 | null {
  if (!arm) return null;
  const named = arm.gripper_joints.length > 0 ? arm.gripper_joints : arm.joints.slice(-1);
  const joints = named.flatMap((name) => root.joints[name.slice(prefix.length)] ?? []);
  if (joints.length === 0) return null;
  const sum = joints.reduce((all, joint) => all.add(joint.getWorldPosition(new THREE.Vector3())), new THREE.Vector3());
  return sum.divideScalar(joints.length);
}
