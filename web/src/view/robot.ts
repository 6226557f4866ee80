// One robot of the cell, built from its URDF text by urdf-loader and moved joint by joint.
//
// The URDF's names carry no prefix; joint names outside are prefix + URDF name. Meshes are not
// loaded (the server does not serve them): a robot is drawn with its primitives, visuals first,
// collision shapes when it has no visual that can be drawn.

import * as THREE from 'three';
import URDFLoader, { type URDFRobot } from 'urdf-loader';
import type { ArmState, CellArm, CellRobot } from '../messages';
import { kStateColours } from '../palette';
import { place } from './shapes';
import { merge_links } from './skin';

const kStill_rad = 1e-5;

interface ArmMark {
  ring: THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial>;
  foot: THREE.Object3D;
}

export class RobotModel {
  readonly root: URDFRobot;
  private readonly marks_ = new Map<string, ArmMark>();
  private readonly joints_: { name: string; key: string; value: number }[];
  private readonly skin_: THREE.MeshStandardMaterial;

  /** Throws when the text is not a URDF. */
  constructor(robot: CellRobot) {
    this.root = parse(robot.urdf);
    this.skin_ = merge_links(this.root);
    place(this.root, robot.base.xyz, robot.base.rpy);
    this.joints_ = Object.keys(this.root.joints).map((key) => ({ name: robot.prefix + key, key, value: NaN }));
    for (const arm of robot.arms) this.marks_.set(arm.name, this.mark(arm, robot.prefix));
  }

  /** Moves the joints; answers whether any has moved visibly. */
  set_q(q: Readonly<Record<string, number>>): boolean {
    let moved = false;
    for (const joint of this.joints_) {
      const value = q[joint.name];
      if (value === undefined || Math.abs(value - joint.value) < kStill_rad) continue;
      joint.value = value;
      this.root.setJointValue(joint.key, value);
      moved = true;
    }
    return moved;
  }

  show_state(arm: string, state: ArmState): void {
    const mark = this.marks_.get(arm);
    if (!mark) return;
    mark.ring.material.color.set(kStateColours[state]);
    mark.ring.material.opacity = state === 'idle' ? 0.5 : 0.95;
    const alarmed = state === 'fault' || state === 'stopped';
    this.skin_.emissive.set(alarmed ? 0x4a0d10 : 0x000000);
  }

  /** The point of the world where the arm stands; null for an arm that is not this robot's. */
  foot(arm: string): THREE.Vector3 | null {
    return this.marks_.get(arm)?.foot.getWorldPosition(new THREE.Vector3()) ?? null;
  }

  private mark(arm: CellArm, prefix: string): ArmMark {
    const first = this.root.joints[(arm.joints[0] ?? '').slice(prefix.length)];
    const foot = first?.parent ?? this.root;
    const ring = new THREE.Mesh(
      new THREE.RingGeometry(0.135, 0.152, 64),
      new THREE.MeshBasicMaterial({ transparent: true, side: THREE.DoubleSide, depthWrite: false, toneMapped: false }),
    );
    ring.position.z = 0.004;
    foot.add(ring);
    return { ring, foot };
  }
}

function parse(urdf: string): URDFRobot {
  const visuals = load(urdf, 'visual');
  return has_meshes(visuals) ? visuals : load(urdf, 'collision');
}

function load(urdf: string, shapes: 'visual' | 'collision'): URDFRobot {
  const loader = new URDFLoader();
  loader.parseVisual = shapes === 'visual';
  loader.parseCollision = shapes === 'collision';
  loader.loadMeshCb = (_url, _manager, done) => done(new THREE.Object3D());
  const robot = loader.parse(urdf);
  // Limits are the server's matter; what it measured is drawn as it is.
  for (const joint of Object.values(robot.joints)) joint.ignoreLimits = true;
  return robot;
}

function has_meshes(root: THREE.Object3D): boolean {
  let found = false;
  root.traverse((node) => { found ||= node instanceof THREE.Mesh; });
  return found;
}
