// Where a tool is to go, by hand: a frame at the tool, dragged by arrows or turned by rings. Nothing moves;
// whoever asked for it is told where it was let go.

import * as THREE from 'three';
import { DragHandles, type Grip } from './drag_handles';
import { place } from './shapes';
import type { Stage } from './stage';

const kAxes_m = 0.14;

/** Of a frame in the world: metres, and roll, pitch, yaw about the fixed axes x, y, z (rad). */
export interface ToolPose { xyz: [number, number, number]; rpy: [number, number, number] }
export interface Tool {
  arm: string;
  /** By its name in the cell or in the URDF; empty: that of the arm's last joint. */
  link: string;
  grip: Grip;
  /** null: where the tool stands. */
  at: ToolPose | null;
  let_go(pose: ToolPose): void;
}

export class ToolGoal {
  private readonly handles_: DragHandles;
  private readonly frame_ = new THREE.Group();
  private tool_: Tool | null = null;

  /** `where`: the link's frame in the world; null: there is no such link. */
  constructor(private readonly stage_: Stage, private readonly where_: (arm: string, link: string) => THREE.Matrix4 | null) {
    this.frame_.add(new THREE.AxesHelper(kAxes_m));
    this.frame_.visible = false;
    stage_.scene.add(this.frame_);
    this.handles_ = new DragHandles(stage_, () => this.tool_?.let_go(pose_of(this.frame_)));
  }

  show(tool: Tool | null): void {
    this.tool_ = tool;
    const stands = tool && !tool.at ? this.where_(tool.arm, tool.link) : null;
    if (tool?.at) place(this.frame_, tool.at.xyz, tool.at.rpy);
    else if (stands) stands.decompose(this.frame_.position, this.frame_.quaternion, new THREE.Vector3());
    this.frame_.visible = Boolean(tool?.at ?? stands);
    this.frame_.updateMatrixWorld(true);
    this.handles_.show(this.frame_.visible ? this.frame_ : null, tool?.grip);
    this.stage_.invalidate(true);
  }

  get is_touched(): boolean {
    return this.handles_.is_touched;
  }

  /** Its middle in the world; null: no tool is in hand. */
  get position(): THREE.Vector3 | null {
    return this.frame_.visible ? this.frame_.position : null;
  }

  close(): void {
    this.handles_.close();
  }
}

export function pose_of(frame: THREE.Object3D): ToolPose {
  // Fixed axes x, y, z are the moving axes z, y, x: three's order 'ZYX'.
  const { x, y, z } = new THREE.Euler().setFromQuaternion(frame.quaternion, 'ZYX');
  return { xyz: frame.position.toArray(), rpy: [x, y, z] };
}
