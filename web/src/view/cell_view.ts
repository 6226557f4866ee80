// The cell in 3D: robots where they stand, moved by pose frames, with a mark and a label per arm.

import * as THREE from 'three';
import type { Arm, Cell, SceneObject } from '../server/messages';
import type { Camera } from '../route/address';
import { kNothing, type Selection } from '../route/selection';
import type { App } from '../state/app';
import { arm_colour, ink, kStateColours, kStateGlyphs } from '../state/palette';
import type { Store } from '../state/store';
import type { Level } from './pace';
import { RobotModel } from './robot';
import { dispose, object_mesh } from './shapes';
import { Stage } from './stage';
import { SurfaceShelf, type Surfaces } from './surfaces';

// Around the bases: a little less than an arm's reach, and as high as arms at work are.
const kReach_m = 0.46;
const kHeight_m = 0.85;

interface Label { element: HTMLElement; name: HTMLElement; state: HTMLElement }

export class CellView {
  private readonly stage_: Stage;
  private readonly robots_ = new Map<string, RobotModel>();
  private readonly labels_ = new Map<string, Label>();
  private objects_ = new THREE.Group();
  private readonly shelf_ = new SurfaceShelf();
  private cell_: Cell | null = null;
  private shown_objects_: SceneObject[] | null = null;
  private readonly off_: (() => void)[];

  private selection_ = kNothing;
  private instant_s_: number | null = null;

  constructor(private readonly host_: HTMLElement, private readonly app_: Pick<App, 'store' | 'router'>) {
    const store_ = this.store_;
    this.stage_ = new Stage(host_);
    this.stage_.scene.add(this.objects_);
    this.stage_.after_draw = () => this.place_labels();
    this.stage_.on_camera = (camera) => app_.router.look_from(camera);
    this.off_ = [store_.on_change(() => this.follow()), store_.on_frame(() => this.move())];
    this.follow();
  }

  close(): void {
    for (const off of this.off_) off();
    for (const label of this.labels_.values()) label.element.remove();
    this.stage_.close();
  }

  /** Lights up what the address points at. */
  show_selection(selection: Selection): void {
    this.selection_ = selection;
    this.light_objects();
    for (const [name, label] of this.labels_) label.element.classList.toggle('lit', selection.arms.includes(name));
    for (const robot of this.robots_.values()) robot.show_lit(selection.arms);
    this.stage_.invalidate();
  }

  /** Where the arms were then; null: where they are. */
  show_instant(t_s: number | null): void {
    this.instant_s_ = t_s;
    this.move();
  }

  /** As an address has it; null leaves it as it is. */
  show_camera(camera: Camera | null): void {
    this.stage_.show_camera(camera);
  }

  show_theme(): void {
    this.stage_.show_theme();
    for (const arm of this.store_.arms.values()) this.show_arm(arm);
    this.light_objects();
  }

  private get store_(): Store {
    return this.app_.store;
  }

  /** So many pixels at the left are covered by a panel: the cell is shown beside it. */
  set_covered(left_px: number): void {
    this.stage_.set_covered(left_px);
  }

  /** Whether every robot of the cell stands in the view. */
  is_drawn(): boolean {
    return this.cell_ !== null && this.robots_.size === this.cell_.robots.length;
  }

  /** Kept once all that changed until now has been drawn. */
  drawn(): Promise<void> {
    return this.stage_.drawn();
  }

  /** How many pictures have been drawn, and how finely the next one will be. */
  pictures(): number {
    return this.stage_.pictures;
  }
  level(): Level {
    return this.stage_.level;
  }

  /** For tests and debugging: a robot is drawn or not. */
  set_robot_visible(name: string, visible: boolean): void {
    const robot = this.robots_.get(name);
    if (!robot) throw new Error(`no robot "${name}"`);
    robot.root.visible = visible;
    this.stage_.invalidate(true);
  }

  private follow(): void {
    const { cell, objects, arms } = this.store_;
    if (cell && cell !== this.cell_) this.build(cell);
    if (objects !== this.shown_objects_) this.show_objects(objects);
    for (const arm of arms.values()) this.show_arm(arm);
    this.move();
    this.stage_.invalidate();
  }

  private build(cell: Cell): void {
    this.cell_ = cell;
    for (const robot of this.robots_.values()) {
      dispose(robot.root);
      this.stage_.scene.remove(robot.root);
    }
    this.robots_.clear();
    this.frame_cell(cell);
    const addresses = cell.robots.flatMap((robot) => Object.values(robot.meshes));
    if (addresses.length === 0) return this.add_robots(cell, new Map());
    void this.shelf_.load(addresses).then((surfaces) => {
      if (this.cell_ !== cell) return;  // another run has begun meanwhile
      this.add_robots(cell, surfaces);
      this.frame_robots();
      this.follow();
    });
  }

  private add_robots(cell: Cell, surfaces: Surfaces): void {
    for (const robot of cell.robots) {
      try {
        const model = new RobotModel(robot, surfaces);
        this.robots_.set(robot.name, model);
        this.stage_.scene.add(model.root);
      } catch (error) {
        console.warn(`robot ${robot.name} cannot be drawn:`, error);
      }
    }
    this.stage_.invalidate(true);
  }

  /** Looks at the robots as they stand: those with meshes come in all sizes. */
  private frame_robots(): void {
    this.move();
    const box = new THREE.Box3();
    for (const robot of this.robots_.values()) box.expandByObject(robot.root);
    if (!box.isEmpty()) this.stage_.frame(box);
  }

  /** Looks at the robots' bases with a little more than an arm's reach around them. */
  private frame_cell(cell: Cell): void {
    const box = new THREE.Box3();
    for (const robot of cell.robots) box.expandByPoint(new THREE.Vector3(...robot.base.xyz));
    if (box.isEmpty()) return;
    box.expandByVector(new THREE.Vector3(kReach_m, kReach_m, 0));
    box.max.z += kHeight_m;
    this.stage_.frame(box);
  }

  private show_objects(objects: SceneObject[]): void {
    this.shown_objects_ = objects;
    const addresses = objects.flatMap(({ mesh }) => mesh ?? []);
    if (addresses.length === 0) return this.add_objects(objects, new Map());
    void this.shelf_.load(addresses).then((surfaces) => {
      if (this.shown_objects_ === objects) this.add_objects(objects, surfaces);
    });
  }

  private add_objects(objects: SceneObject[], surfaces: Surfaces): void {
    dispose(this.objects_);
    this.objects_.clear();
    for (const object of objects) {
      const surface = object.mesh === undefined ? null : surfaces.get(object.mesh);
      const mesh = object_mesh(object, surface ?? null);
      if (!mesh) continue;
      mesh.name = object.name;
      this.objects_.add(mesh);
    }
    this.light_objects();
    this.stage_.invalidate(true);
  }

  private light_objects(): void {
    const colour = new THREE.Color(ink('--blue'));
    for (const object of this.objects_.children) {
      const lit = object.name === this.selection_.object;
      object.traverse((node) => {
        const material = node instanceof THREE.Mesh ? (node.material as THREE.Material) : null;
        if (!(material instanceof THREE.MeshStandardMaterial)) return;
        material.color.set(ink('--object'));
        material.emissive.copy(colour).multiplyScalar(lit ? 0.45 : 0);
      });
    }
  }

  private show_arm(arm: Arm): void {
    this.robots_.get(arm.robot)?.show_state(arm.name, arm.state);
    let label = this.labels_.get(arm.name);
    if (!label) {
      label = make_label();
      this.labels_.set(arm.name, label);
      this.host_.append(label.element);
    }
    label.name.textContent = arm.name;
    label.state.textContent = `${kStateGlyphs[arm.state]} ${arm.state}`;
    label.element.classList.toggle('lit', this.selection_.arms.includes(arm.name));
    label.element.style.setProperty('--arm', arm_colour([...this.store_.arms.keys()], arm.name));
    label.element.style.setProperty('--state', kStateColours[arm.state]);
  }

  private move(): void {
    let moved = false;
    const q = this.instant_s_ === null ? this.store_.q : this.store_.trace.at(this.instant_s_) ?? this.store_.q;
    for (const robot of this.robots_.values()) moved = robot.set_q(q) || moved;
    if (moved) this.stage_.invalidate(true);
  }

  private place_labels(): void {
    for (const [name, label] of this.labels_) {
      const robot = this.robots_.get(this.store_.arms.get(name)?.robot ?? '');
      const foot = robot?.root.visible ? robot.foot(name) : null;
      const p = foot ? this.stage_.to_page(foot) : null;
      label.element.hidden = p === null;
      if (p) label.element.style.transform = `translate(${p.x.toFixed(1)}px, ${p.y.toFixed(1)}px)`;
    }
  }
}

function make_label(): Label {
  const element = document.createElement('div');
  const name = document.createElement('b');
  const state = document.createElement('span');
  element.className = 'arm-label';
  element.append(name, state);
  return { element, name, state };
}
