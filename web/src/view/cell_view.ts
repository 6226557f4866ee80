// The cell in 3D: robots at their measured positions, with a label for each arm.

import * as THREE from 'three';
import type { Arm, Cell } from '../server/messages';
import type { Address, Camera } from '../route/address';
import type { Selection } from '../route/selection';
import type { App } from '../state/app';
import { arm_color, ink } from '../state/palette';
import { instant_of, pose_at, type Instant } from '../state/instant';
import type { Store } from '../state/store';
import { arm_in_words } from '../wording';
import type { Level } from './pace';
import { Ahead } from './ahead';
import { on_click } from './click';
import { Distances } from './distances';
import { box_around_bases } from './framing';
import { Ghosts } from './ghosts';
import { DragHandles } from './drag_handles';
import { ArmLabels } from './labels';
import type { RobotModel } from './robot';
import { Robots } from './robots';
import { SceneObjects } from './scene_objects';
import { Stage } from './stage';
import type { CameraStep } from './steer';
import { SurfaceShelf, type Surfaces } from './surfaces';
import { ToolGoal } from './tool_goal';
import { ToolPaths } from './tool_path';

// With more arms than this, only the closest pair and pairs near the limit are labeled, because
// more labels would cover the tools.
const kFewArms = 4;

export class CellView {
  private readonly stage_: Stage;
  private readonly robots_ = new Robots();
  private readonly ghosts_ = new Ghosts();
  private readonly ahead_: Ahead;
  private readonly distances_: Distances;
  private surfaces_: Surfaces = new Map();
  private readonly paths_ = new ToolPaths();
  private readonly labels_: ArmLabels;
  private readonly shelf_ = new SurfaceShelf();
  private readonly objects_: SceneObjects;
  private readonly drag_handles_: DragHandles;
  private readonly tool_: ToolGoal;
  private cell_: Cell | null = null;
  private readonly off_: (() => void)[];

  /**
   * The arm states at the last drawing. Arms are drawn again only after a change, because drawing
   * is expensive.
   */
  private states_ = '';
  /** The time that the view shows. */
  private at_: Pick<Address, 't_s' | 'run'>;
  /** The request for the animation frame that builds the next ghost. At most one is pending. */
  private builds_: number | null = null;

  constructor(host_: HTMLElement, private readonly app_: Pick<App, 'store' | 'router' | 'seen' | 'covered_px' | 'motions' | 'settings' | 'actions' | 'dragged_object' | 'tool'>) {
    const store_ = this.store_;
    this.at_ = app_.router.address.peek();
    this.robots_.group.visible = this.paths_.group.visible = false;  // hidden until a pose is known
    this.stage_ = new Stage(host_);
    this.labels_ = new ArmLabels(host_);
    this.objects_ = new SceneObjects(this.shelf_, (arm, link) => this.robot_of(arm)?.link(link) ?? null, (arm) => arm_color([...store_.arms.keys()], arm), () => this.stage_.invalidate(true));
    this.ahead_ = new Ahead(app_);
    this.distances_ = new Distances(host_, (body) => this.drawn_of(body));
    this.stage_.scene.add(this.robots_.group, this.objects_.group, this.ghosts_.group, this.ahead_.group, this.distances_.group, this.paths_.group);
    this.stage_.after_draw = () => this.place_labels();
    this.stage_.on_level = ({ ghosts }) => this.ahead_.show_level(ghosts);
    this.drag_handles_ = new DragHandles(this.stage_, (object) => this.put_dragged(object));
    this.tool_ = new ToolGoal(this.stage_, (arm, link) => this.robot_of(arm)?.frame_of(arm, link) ?? null);
    on_click(this.stage_.canvas, (x_px, y_px) => this.pick(x_px, y_px));
    this.stage_.on_camera = (camera) => app_.router.look_from(camera);
    this.off_ = [
      store_.on_change(() => this.follow()), store_.on_frame(() => this.move()), store_.on_beat(() => this.measure()),
      app_.motions.changes.subscribe(() => this.look_ahead()), app_.settings.shows.subscribe(() => this.show_shows()),
      app_.dragged_object.subscribe(() => this.update_dragged()), app_.tool.subscribe((tool) => this.tool_.show(tool)), app_.seen.store.subscribe(() => this.follow()),
      app_.covered_px.subscribe((left_px) => this.stage_.set_covered(left_px)),
    ];
    this.follow();
  }

  close(): void {
    for (const off of this.off_) off();
    if (this.builds_ !== null) cancelAnimationFrame(this.builds_);
    this.labels_.clear();
    this.distances_.clear();
    this.drag_handles_.close();
    this.tool_.close();
    this.stage_.close();
  }

  /** Highlights what the address selects. */
  show_selection(selection: Selection): void {
    this.objects_.light(selection.object);
    this.labels_.light(selection.arms);
    this.robots_.show_lit(selection.arms);
    this.stage_.invalidate();
  }

  /** Shows the arms as they were at a time. Shows no arms if their positions are unknown. */
  show_instant(at: Pick<Address, 't_s' | 'run'>): void {
    this.at_ = at;
    this.paths_.clear();
    this.move();
    this.show_shows();
  }

  /** Shows a ghost with these joint positions, or no ghost if null. */
  show_ghost(q: Readonly<Record<string, number>> | null): void {
    if (!this.cell_) return;
    const names = [...this.store_.arms.keys()];
    const color = (arm: string) => ink(arm_color(names, arm));
    while (!this.ghosts_.show({ q, now: this.store_.q }, this.cell_, this.surfaces_, color));
    this.stage_.invalidate(true);
  }

  /** Moves the camera to this position and target. Null leaves the camera unchanged. */
  show_camera(camera: Camera | null): void { this.stage_.show_camera(camera); }

  /** Moves the camera by one step, for a button or a key. */
  steer(step: CameraStep): void { this.stage_.steer(step); }

  show_theme(): void {
    this.stage_.show_theme();
    for (const arm of this.seen_.arms.values()) this.show_arm(arm);
    this.objects_.repaint();
    this.ahead_.begin(this.cell_);
    this.show_shows();
  }

  private get store_(): Store {
    return this.app_.store;
  }
  /** The state at the time that the view shows. */
  private get seen_(): Store {
    return this.app_.seen.store.peek();
  }
  private robot_of(arm: string): RobotModel | null {
    return this.robots_.get(this.store_.arms.get(arm)?.robot);
  }
  private get instant(): Instant {
    return instant_of(this.at_, this.store_);
  }

  /** Returns true if every robot of the cell is in the view. */
  is_drawn(): boolean {
    return this.cell_ !== null && this.robots_.size === this.cell_.robots.length;
  }

  /** Resolves when all changes so far are drawn. */
  drawn(): Promise<void> { return this.stage_.drawn(); }

  /** Returns the center of an object, px from the view's top left. */
  where_is(object: string): { x: number; y: number } | null {
    const found = this.objects_.find(object);
    return found ? this.stage_.to_page(found.getWorldPosition(new THREE.Vector3())) : null;
  }
  /** Returns the center of the dragged tool goal, px from the view's top left. */
  where_is_tool(): { x: number; y: number } | null {
    return this.tool_.position ? this.stage_.to_page(this.tool_.position) : null;
  }

  /** Returns the number of drawn tool paths. */
  ahead(): number { return this.ahead_.count; }
  /** Returns the number of drawn frames, and the present level of detail. */
  pictures(): number { return this.stage_.pictures; }
  level(): Level { return this.stage_.level; }

  /** Shows or hides a robot. For tests and debugging. */
  set_robot_visible(name: string, visible: boolean): void {
    this.robots_.set_visible(name, visible);
    this.stage_.invalidate(true);
  }

  private follow(): void {
    const { cell } = this.store_;
    const { objects, held, arms } = this.seen_;
    if (cell && cell !== this.cell_) this.build(cell);
    this.objects_.show(objects, held);
    this.update_dragged();
    const states = [...arms.values()].map((arm) => `${arm.name} ${arm_in_words(arm, this.seen_)}`).join('\n');
    if (states !== this.states_) {
      for (const arm of arms.values()) this.show_arm(arm);
      this.stage_.invalidate();
    }
    this.states_ = states;
    this.move();
    this.look_ahead();
  }

  private update_dragged(): void {
    if (this.drag_handles_.show(this.objects_.find(this.app_.dragged_object.peek()))) this.stage_.invalidate();
  }

  private put_dragged({ name, position }: THREE.Object3D): void {
    const object = this.store_.objects.find((one) => one.name === name);
    const xyz = position.toArray().map((m) => Number(m.toFixed(3))) as [number, number, number];
    if (object) void this.app_.actions.move_object(object, xyz).then((moved) => { if (!moved) this.objects_.renew(); });
  }

  private show_shows(): void {
    this.look_ahead();
    this.measure();
    this.stage_.invalidate();
  }

  private look_ahead(): void {
    if (this.ahead_.follow(this.surfaces_, this.instant.kind === 'now')) this.stage_.invalidate();
    if (!this.ahead_.lacks_ghosts || this.builds_ !== null) return;
    this.builds_ = requestAnimationFrame(() => {
      this.builds_ = null;
      this.look_ahead();
    });
  }

  /** Updates the lines of the closest pairs that the monitor measured. */
  private measure(): void {
    const shown = this.app_.settings.shows.peek().distances && this.instant.kind === 'now';
    const changed = this.distances_.show(shown ? this.store_.clearance : [], this.store_.cell?.clearance_m ?? 0, this.store_.arms.size > kFewArms ? 1 : Infinity);
    if (changed) this.stage_.invalidate();
  }

  private drawn_of(body: string): THREE.Mesh | null {
    const object = this.objects_.find(body);
    return this.robots_.skin_of(body) ?? (object instanceof THREE.Mesh ? object : null);
  }

  private place_labels(): void {
    this.labels_.place((arm) => this.where_stands(arm));
    this.distances_.place((p_W) => this.stage_.to_page(p_W));
  }

  private build(cell: Cell): void {
    this.cell_ = cell;
    this.robots_.clear();
    this.labels_.clear();
    this.paths_.clear();
    this.ghosts_.clear();
    this.ahead_.begin(cell);
    const box = box_around_bases(cell);
    if (box) this.stage_.frame(box);
    const addresses = cell.robots.flatMap((robot) => Object.values(robot.meshes));
    if (addresses.length === 0) {
      this.add_robots(cell, new Map());
      return this.objects_.renew();
    }
    void this.shelf_.load(addresses).then((surfaces) => {
      if (this.cell_ !== cell) return;  // another cell is shown meanwhile
      this.add_robots(cell, surfaces);
      this.frame_robots(cell);
      this.objects_.renew();
      this.follow();
    });
  }

  private add_robots(cell: Cell, surfaces: Surfaces): void {
    this.surfaces_ = surfaces;
    this.states_ = '';
    this.robots_.add(cell, surfaces);
    this.stage_.invalidate(true);
  }

  /**
   * Moves the camera so that all robots are visible at their home positions; their size is known
   * only now, with their meshes. The home positions are used so that a camera in an address means
   * the same wherever the robots are.
   */
  private frame_robots(cell: Cell): void {
    this.robots_.set_home(cell);
    const box = new THREE.Box3().setFromObject(this.robots_.group);
    if (!box.isEmpty()) this.stage_.frame(box);
  }

  private show_arm(arm: Arm): void {
    this.robots_.get(arm.robot)?.show_state(arm.name, this.seen_.arm_state(arm));
    this.labels_.show(arm.name, this.seen_.arm_state(arm), [...this.store_.arms.keys()], arm_in_words(arm, this.seen_));
  }

  private move(): void {
    const q = pose_at(this.instant, this.store_);
    if (this.robots_.group.visible !== (q !== null)) {
      this.robots_.group.visible = this.paths_.group.visible = q !== null;
      this.stage_.invalidate(true);
      // Draws at once: on a busy machine the next frame may be seconds away, and the visible frame
      // shows wrong positions.
      this.stage_.hurry();
      if (q === null) this.labels_.hide();
    }
    if (q === null || !this.robots_.set_q(q)) return;
    this.paths_.follow(this.robots_, this.store_.arms, this.at_.t_s ?? this.store_.t_s);
    this.ahead_.move();
    this.stage_.invalidate(true);
  }

  private where_stands(arm: string): { x: number; y: number } | null {
    const foot = this.robots_.foot_of(this.store_.arms.get(arm));
    return foot ? this.stage_.to_page(foot) : null;
  }

  /** Opens the page of the clicked arm or object. */
  private pick(x_px: number, y_px: number): void {
    if (this.drag_handles_.is_touched || this.tool_.is_touched) return;
    const sight = this.stage_.sight(x_px, y_px);
    const robots = this.robots_.group.visible ? [this.robots_.group] : [];
    const hit = sight.intersectObjects([...robots, ...this.objects_.group.children], true)[0]?.object;
    if (!hit) return;
    const object = this.objects_.name_of(hit);
    const arm = this.robots_.arm_of(hit);
    if (object !== null) this.app_.router.go({ page: 'scene', name: object });
    else if (arm !== null) this.app_.router.go({ page: 'arm', name: arm });
  }
}
