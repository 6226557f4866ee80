// The goal of a tool in the 3D view: a frame that the user drags by arrows or rings. No arm moves.
// The pose is reported when the user releases the handle.

import * as THREE from 'three';
import { DragHandles, type Grip } from './drag_handles';
import { place } from './shapes';
import type { Stage } from './stage';

const kAxes_m = 0.14;

/** A pose in the world: meters, and roll, pitch, yaw about the fixed axes x, y, z (rad). */
export interface ToolPose { xyz: [number, number, number]; rpy: [number, number, number] }
export interface Tool {
  arm: string;
  /**
   * The link's name in the cell or in the URDF. An empty name means the link that the arm's last
   * joint moves.
   */
  link: string;
  grip: Grip;
  /** The pose of the goal, or null to begin at the tool's current pose. */
  at: ToolPose | null;
  on_release(pose: ToolPose): void;
}

export class ToolGoal {
  private readonly handles_: DragHandles;
  private readonly frame_ = new THREE.Group();
  private tool_: Tool | null = null;

  /** `where` returns the pose of a link in the world frame, or null if there is no such link. */
  constructor(private readonly stage_: Stage, private readonly where_: (arm: string, link: string) => THREE.Matrix4 | null) {
    this.frame_.add(new THREE.AxesHelper(kAxes_m));
    this.frame_.visible = false;
    stage_.scene.add(this.frame_);
    this.handles_ = new DragHandles(stage_, () => this.tool_?.on_release(pose_of(this.frame_)));
  }

  show(tool: Tool | null): void {
    this.tool_ = tool;
    const tool_pose = tool && !tool.at ? this.where_(tool.arm, tool.link) : null;
    if (tool?.at) place(this.frame_, tool.at.xyz, tool.at.rpy);
    else if (tool_pose) tool_pose.decompose(this.frame_.position, this.frame_.quaternion, new THREE.Vector3());
    this.frame_.visible = Boolean(tool?.at ?? tool_pose);
    this.frame_.updateMatrixWorld(true);
    this.handles_.show(this.frame_.visible ? this.frame_ : null, tool?.grip);
    this.stage_.invalidate(true);
  }

  get is_touched(): boolean {
    return this.handles_.is_touched;
  }

  /** The goal's position in the world frame, or null if there is no goal. */
  get position(): THREE.Vector3 | null {
    return this.frame_.visible ? this.frame_.position : null;
  }

  close(): void {
    this.handles_.close();
  }
}

export function pose_of(frame: THREE.Object3D): ToolPose {
  // Rotations about the fixed axes x, y, z equal rotations about the moving axes z, y, x, which is
  // three's order 'ZYX'.
  const { x, y, z } = new THREE.Euler().setFromQuaternion(frame.quaternion, 'ZYX');
  return { xyz: frame.position.toArray(), rpy: [x, y, z] };
}
