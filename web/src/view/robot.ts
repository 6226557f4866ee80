// A drawn robot, built from its URDF by urdf-loader.
//
// Joint names in the URDF have no prefix. Outside of this file a joint's name is the prefix and the
// URDF name. A robot is drawn by its visuals. A link whose visual meshes cannot be read is drawn by
// its collision shapes, as are all links of a robot without visuals. A link with no readable shape
// is drawn as a marker.

import * as THREE from 'three';
import URDFLoader, { type URDFRobot } from 'urdf-loader';
import type { CellArm, CellRobot } from '../server/messages';
import { ink, kStateColors } from '../state/palette';
import { FinishedMesh } from './finish';
import { is_alarming, type ShownState } from '../state/shown_state';
import type { Surfaces } from './surfaces';
import { tool_of } from './kinematics';
import { mark_geometry, place } from './shapes';
import { give_skin, merge_links } from './skin';

const kLitRing = 1.45;
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
  private readonly arms_: readonly CellArm[];
  private readonly prefix_: string;

  /** `surfaces` are the robot's meshes by address. Throws if the robot's text is not a URDF. */
  constructor(robot: CellRobot, surfaces: Surfaces = new Map()) {
    this.arms_ = robot.arms;
    this.prefix_ = robot.prefix;
    this.root = pattern_of(robot, surfaces).clone();
    // Measured positions are drawn even if they are beyond the joint limits.
    for (const joint of Object.values(this.root.joints)) joint.ignoreLimits = true;
    this.skin_ = give_skin(this.root);
    place(this.root, robot.base.xyz, robot.base.rpy);
    this.joints_ = Object.keys(this.root.joints).map((key) => ({ name: robot.prefix + key, key, value: NaN }));
    for (const arm of robot.arms) this.marks_.set(arm.name, this.mark(arm, robot.prefix));
  }

  /** Moves the joints. Returns true if any joint moved visibly. */
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

  show_state(arm: string, state: ShownState): void {
    const mark = this.marks_.get(arm);
    if (!mark) return;
    mark.ring.material.color.set(ink(kStateColors[state]));
    mark.ring.material.opacity = state === 'idle' ? 0.5 : 0.95;
    this.skin_.emissive.set(is_alarming(state) ? 0x4a0d10 : 0x000000);
  }

  /** Widens the rings of the selected arms. */
  show_lit(arms: readonly string[]): void {
    for (const [arm, mark] of this.marks_) mark.ring.scale.setScalar(arms.includes(arm) ? kLitRing : 1);
  }

  /**
   * Returns the arm's base point in the world frame. Null if the arm does not belong to this robot.
   */
  foot(arm: string): THREE.Vector3 | null {
    return this.marks_.get(arm)?.foot.getWorldPosition(new THREE.Vector3()) ?? null;
  }

  /**
   * Returns the tool's position in the world frame: the middle between the fingers, or the last
   * joint if the arm has no gripper.
   */
  tool(arm: string): THREE.Vector3 | null {
    return tool_of(this.root, this.prefix_, this.arms_.find((one) => one.name === arm));
  }

  /**
   * Returns the pose of a link in the world frame, or null. `link` is the link's name with or
   * without the prefix. An empty name means the link that the arm's last joint moves.
   */
  frame_of(arm: string, link: string): THREE.Matrix4 | null {
    const last = this.arms_.find((one) => one.name === arm)?.joints.at(-1);
    const found = link === '' ? this.root.joints[(last ?? '').slice(this.prefix_.length)] : this.link(link);
    found?.updateWorldMatrix(true, false);
    return found?.matrixWorld.clone() ?? null;
  }

  /** Returns a link, or null. `link` is the link's name with or without the prefix. */
  link(link: string): THREE.Object3D | null {
    const own = link.startsWith(this.prefix_) ? link.slice(this.prefix_.length) : link;
    return this.root.links[own] ?? this.root.links[link] ?? null;
  }

  /** Returns the drawn mesh of a link. `link` is the link's name with the prefix. */
  skin_of(link: string): THREE.Mesh | null {
    const known = link.startsWith(this.prefix_) ? this.root.links[link.slice(this.prefix_.length)] : undefined;
    return known?.children.find((child): child is FinishedMesh => child instanceof FinishedMesh) ?? null;
  }

  /**
   * Returns the arm to which a drawn object belongs, or null. Parts that no arm's joint moves
   * belong to the robot's arm if it has only one.
   */
  arm_of(node: THREE.Object3D): string | null {
    let inside = false;
    for (let at: THREE.Object3D | null = node; at; at = at.parent) {
      const joint = 'isURDFJoint' in at ? this.prefix_ + at.name : null;
      const arm = joint === null ? undefined : this.arms_.find(({ joints, gripper_joints }) => joints.includes(joint) || gripper_joints.includes(joint));
      if (arm) return arm.name;
      inside ||= at === this.root;
    }
    return inside && this.arms_.length === 1 ? this.arms_[0]?.name ?? null : null;
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

// One parsed and merged robot for each URDF, because both steps are slow. Equal robots and their
// ghosts are copies of it. The cache is kept as long as the surfaces.
const patterns = new WeakMap<Surfaces, Map<string, URDFRobot>>();

function pattern_of(robot: CellRobot, surfaces: Surfaces): URDFRobot {
  const known = patterns.get(surfaces) ?? new Map<string, URDFRobot>();
  patterns.set(surfaces, known);
  const looks = JSON.stringify([robot.urdf, robot.meshes]);
  const pattern = known.get(looks) ?? load(robot, surfaces);
  known.set(looks, pattern);
  return pattern;
}

function load(robot: CellRobot, surfaces: Surfaces): URDFRobot {
  const loader = new URDFLoader();
  loader.parseVisual = true;
  loader.parseCollision = true;
  // The server's table of meshes uses the mesh names of the URDF, so these names must stay
  // unchanged.
  loader.packages = (name: string) => `package://${name}`;
  loader.loadMeshCb = (name, _manager, done) => {
    const surface = surfaces.get(robot.meshes[name] ?? '') ?? null;
    const mesh = new THREE.Mesh(surface ?? undefined);
    mesh.userData['missing'] = surface === null;
    done(mesh);
  };
  const root = loader.parse(robot.urdf);
  choose_shapes(root);
  merge_links(root);
  return root;
}

/**
 * Removes the shapes that are not drawn, so that each link has either visuals or collision shapes.
 * A mesh that cannot be read must be marked `missing`.
 */
export function choose_shapes(root: Pick<URDFRobot, 'links'>): void {
  const links = Object.values(root.links).map((link) => {
    const of_kind = (kind: string) => link.children.filter((child) => kind in child);
    return { link, visuals: of_kind('isURDFVisual'), colliders: of_kind('isURDFCollider') };
  });
  const any_visual = links.some(({ visuals }) => visuals.some((visual) => meshes_below(visual).some(is_read)));
  for (const { link, visuals, colliders } of links) {
    const named = visuals.flatMap(meshes_below);
    const by_colliders = !named.some(is_read) && (named.length > 0 || !any_visual);
    const color = named.find((mesh) => !is_read(mesh))?.material;
    for (const node of by_colliders ? visuals : colliders) node.removeFromParent();
    const drawn = (by_colliders ? colliders : visuals).flatMap(meshes_below);
    for (const mesh of drawn) {
      if (!is_read(mesh)) mesh.removeFromParent();
      else if (by_colliders && color) mesh.material = color;
    }
    if (drawn.length > 0 && !drawn.some(is_read)) link.add(new THREE.Mesh(mark_geometry(), new THREE.MeshPhongMaterial()));
  }
}

function meshes_below(root: THREE.Object3D): THREE.Mesh[] {
  const found: THREE.Mesh[] = [];
  root.traverse((node) => { if (node instanceof THREE.Mesh) found.push(node); });
  return found;
}

function is_read(mesh: THREE.Mesh): boolean {
  return mesh.userData['missing'] !== true;
}
