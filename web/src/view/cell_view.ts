// The cell in 3D: robots where they stand, moved by pose frames, with a mark and a label per arm.

import * as THREE from 'three';
import type { Arm, Cell } from '../server/messages';
import type { Camera } from '../route/address';
import type { Selection } from '../route/selection';
import type { App } from '../state/app';
import { arm_colour, ink } from '../state/palette';
import type { Store } from '../state/store';
import type { Level } from './pace';
import { RobotModel } from './robot';
import { on_click } from './click';
import { Ghosts } from './ghosts';
import { ArmLabels } from './labels';
import { SceneObjects } from './scene_objects';
import { dispose } from './shapes';
import { Stage } from './stage';
import { SurfaceShelf, type Surfaces } from './surfaces';
import { ToolPath } from './tool_path';

// Around the bases: a little less than an arm's reach, and as high as arms at work are.
const kReach_m = 0.46;
const kHeight_m = 0.85;

export class CellView {
  private readonly stage_: Stage;
  private readonly robots_ = new Map<string, RobotModel>();
  private readonly ghosts_ = new Ghosts();
  private surfaces_: Surfaces = new Map();
  private readonly paths_ = new Map<string, ToolPath>();
  private readonly labels_: ArmLabels;
  private readonly shelf_ = new SurfaceShelf();
  private readonly objects_: SceneObjects;
  private cell_: Cell | null = null;
  private readonly off_: (() => void)[];

  private instant_s_: number | null = null;

  constructor(host_: HTMLElement, private readonly app_: Pick<App, 'store' | 'router'>) {
    const store_ = this.store_;
    this.stage_ = new Stage(host_);
    this.labels_ = new ArmLabels(host_);
    this.objects_ = new SceneObjects(this.shelf_, () => this.stage_.invalidate(true));
    this.stage_.scene.add(this.objects_.group, this.ghosts_.group);
    this.stage_.after_draw = () => this.labels_.place((arm) => this.where_stands(arm));
    on_click(this.stage_.canvas, (x_px, y_px) => this.pick(x_px, y_px));
    this.stage_.on_camera = (camera) => app_.router.look_from(camera);
    this.off_ = [store_.on_change(() => this.follow()), store_.on_frame(() => this.move())];
    this.follow();
  }

  close(): void {
    for (const off of this.off_) off();
    this.labels_.clear();
    this.stage_.close();
  }

  /** Lights up what the address points at. */
  show_selection(selection: Selection): void {
    this.objects_.light(selection.object);
    this.labels_.light(selection.arms);
    for (const robot of this.robots_.values()) robot.show_lit(selection.arms);
    this.stage_.invalidate();
  }

  /** Where the arms were then; null: where they are. */
  show_instant(t_s: number | null): void {
    this.instant_s_ = t_s;
    for (const path of this.paths_.values()) path.clear();
    this.move();
  }

  /** Arms as they would stand with these joints; null: no ghost. */
  show_ghost(q: Readonly<Record<string, number>> | null): void {
    if (!this.cell_) return;
    const names = [...this.store_.arms.keys()];
    this.ghosts_.show(q, this.store_.q, this.cell_, this.surfaces_, (arm) => ink(arm_colour(names, arm)));
    this.stage_.invalidate();
  }

  /** As an address has it; null leaves it as it is. */
  show_camera(camera: Camera | null): void {
    this.stage_.show_camera(camera);
  }

  show_theme(): void {
    this.stage_.show_theme();
    for (const arm of this.store_.arms.values()) this.show_arm(arm);
    this.objects_.repaint();
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
    this.objects_.show(objects);
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
    this.ghosts_.clear();
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
    this.surfaces_ = surfaces;
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

  private show_arm(arm: Arm): void {
    this.robots_.get(arm.robot)?.show_state(arm.name, arm.state);
    this.labels_.show(arm, [...this.store_.arms.keys()]);
  }

  private move(): void {
    let moved = false;
    const q = this.instant_s_ === null ? this.store_.q : this.store_.trace.at(this.instant_s_) ?? this.store_.q;
    for (const robot of this.robots_.values()) moved = robot.set_q(q) || moved;
    if (!moved) return;
    this.draw_paths(this.instant_s_ ?? this.store_.t_s);
    this.stage_.invalidate(true);
  }

  /** Where each tool has come from, in its arm's colour. */
  private draw_paths(t_s: number): void {
    const names = [...this.store_.arms.keys()];
    for (const arm of this.store_.arms.values()) {
      const p_W = this.robots_.get(arm.robot)?.tool(arm.name);
      if (!p_W) continue;
      let path = this.paths_.get(arm.name);
      if (!path) {
        path = new ToolPath();
        this.paths_.set(arm.name, path);
        this.stage_.scene.add(path.line);
      }
      path.pass(t_s, p_W, new THREE.Color(ink(arm_colour(names, arm.name))));
    }
  }

  private where_stands(arm: string): { x: number; y: number } | null {
    const robot = this.robots_.get(this.store_.arms.get(arm)?.robot ?? '');
    const foot = robot?.root.visible ? robot.foot(arm) : null;
    return foot ? this.stage_.to_page(foot) : null;
  }

  /** What was clicked, an arm or an object, is looked at. */
  private pick(x_px: number, y_px: number): void {
    const sight = this.stage_.sight(x_px, y_px);
    const robots = [...this.robots_.values()];
    const hit = sight.intersectObjects([...robots.map((robot) => robot.root), ...this.objects_.group.children], true)[0]?.object;
    if (!hit) return;
    const object = this.objects_.name_of(hit);
    const arm = robots.map((robot) => robot.arm_of(hit)).find((name) => name !== null) ?? null;
    if (object !== null) this.app_.router.go({ page: 'scene', name: object });
    else if (arm !== null) this.app_.router.go({ page: 'arm', name: arm });
  }
}
