// The stage of the 3D view: renderer, camera, lights, floor, and drawing when needed.
//
// In the world frame z is up, and lengths are in meters. Frames are drawn only after invalidate(),
// as often and as finely as pace.ts allows. Without a graphics card (panel PC, browser test) or on
// a busy machine, a frame may take 0.1 s of all cores or more. A fence behind each frame measures
// how long the frame really takes. Without a graphics card antialiasing is off, unless the address
// has `?fine` (for pictures of the page).

import * as THREE from 'three';
import type { Camera } from '../route/address';
import { ink } from '../state/palette';
import { renders_in_software, wants_fine_picture } from './drawing_power';
import { Fence } from './fence';
import { show_finish } from './finish';
import { kFirstInSoftware, kLevels, Pace, type Level } from './pace';
import { make_renderer } from './renderer';
import { add_lights, floor, light_up } from './scenery';
import type { CameraStep } from './steer';
import { Viewpoint } from './viewpoint';

THREE.Object3D.DEFAULT_UP.set(0, 0, 1);

const kLate_ms = 20;
// Time from the start of a frame in full quality to the next frame, as a multiple of the frame's
// duration. The pause is then as long as the frame took.
const kShareOfWhole = 2;
const kRest_ms = 900;
// If frames are slow, no new frame starts for this time after a click or a key, so that the page
// answers first.
const kAnswer_ms = 200;

export class Stage {
  readonly scene = new THREE.Scene();
  /** Called after each frame. Labels that follow points of the scene are moved then. */
  after_draw: () => void = () => {};
  /** Called when the level of detail changes. */
  on_level: (level: Level) => void = () => {};

  private readonly renderer_: THREE.WebGLRenderer;
  private readonly viewpoint_: Viewpoint;
  private floor_: THREE.Group | null = null;
  private covered_px_ = 0;
  private frame_: number | null = null;
  private drawn_at_ms_ = 0;
  private next_at_ms_ = 0;
  private hurried_ = false;
  private readonly fence_: Fence;
  private readonly pace_: Pace;
  private readonly full_ratio_: number;
  private readonly key_light_: THREE.DirectionalLight;
  private pictures_ = 0;
  private shapes_moved_ = true;  // true if a shape has moved since the shadows were last drawn
  private shown_: Level | undefined = kLevels[0];
  private readonly waiting_: (() => void)[] = [];
  private rest_timer_: number | null = null;
  private at_rest_ = false;
  private whole_ = false;
  private resized_ = false;
  private readonly closed_ = new AbortController();

  constructor(private readonly host_: HTMLElement) {
    const software = renders_in_software();
    const fine = wants_fine_picture() || !software;
    this.pace_ = new Pace(software ? kFirstInSoftware : 0);
    this.renderer_ = make_renderer(fine);
    this.full_ratio_ = fine ? Math.min(2, window.devicePixelRatio) : 1;
    this.renderer_.setPixelRatio(this.full_ratio_);
    this.fence_ = new Fence(this.renderer_.getContext() as WebGL2RenderingContext);
    host_.prepend(this.renderer_.domElement);

    this.viewpoint_ = new Viewpoint(this.renderer_.domElement, () => {
      this.whole_ = false;
      this.invalidate();
    });
    this.scene.fog = this.viewpoint_.fog;
    this.key_light_ = add_lights(this.scene);
    this.show_theme();
    new ResizeObserver(() => this.resize()).observe(host_);
    for (const what of ['click', 'keydown']) window.addEventListener(what, () => this.give_way(), { capture: true, signal: this.closed_.signal });
    this.resize();
  }

  get pictures(): number { return this.pictures_; }
  get level(): Level { return this.pace_.level; }
  get camera(): THREE.PerspectiveCamera { return this.viewpoint_.camera; }
  get canvas(): HTMLCanvasElement { return this.renderer_.domElement; }

  /**
   * Called when the user moved the camera. Null means that the camera is back in the default view.
   */
  set on_camera(tell: (camera: Camera | null) => void) { this.viewpoint_.on_camera = tell; }

  /**
   * Moves the camera so that a box is visible. The view stays so until the user moves the camera.
   */
  frame(box: THREE.Box3): void {
    const radius_m = box.getBoundingSphere(new THREE.Sphere()).radius;
    this.viewpoint_.frame(box, radius_m);
    light_up(this.key_light_, box.getCenter(new THREE.Vector3()), Math.max(1.7, radius_m));
    this.resize();
  }

  /** Moves the camera to this position and target. Null leaves the camera unchanged. */
  show_camera(camera: Camera | null): void {
    if (camera && this.viewpoint_.show(camera)) this.invalidate();
  }

  /** Moves the camera by one step, for a button or a key. */
  steer(step: CameraStep): void {
    this.viewpoint_.steer(step);
    this.invalidate();
  }

  show_theme(): void {
    this.viewpoint_.fog.color.set(ink('--view-far'));
    if (this.floor_) this.scene.remove(this.floor_);
    this.floor_ = floor();
    this.scene.add(this.floor_);
    this.invalidate();
  }

  /** Frees the memory of the graphics card. */
  close(): void {
    if (this.frame_ !== null) cancelAnimationFrame(this.frame_);
    if (this.rest_timer_ !== null) clearTimeout(this.rest_timer_);
    this.closed_.abort();
    this.fence_.close();
    this.viewpoint_.close();
    this.renderer_.dispose();
    this.renderer_.domElement.remove();
  }

  /** Sets the width of the left part of the view that the pane covers. */
  set_covered(left_px: number): void {
    if (left_px === this.covered_px_) return;
    this.covered_px_ = left_px;
    this.resize();
  }

  /** Requests a frame. If `shapes_moved` is true, the shadows are drawn again as well. */
  invalidate(shapes_moved = false): void {
    this.shapes_moved_ ||= shapes_moved;
    if (shapes_moved) this.whole_ = false;
    if (this.frame_ !== null) return;
    const draw = (now_ms: number) => {
      if (this.fence_.is_up || (now_ms < this.next_at_ms_ && !this.hurried_)) {
        this.frame_ = requestAnimationFrame(draw);
        return;
      }
      this.frame_ = null;
      this.draw();
    };
    this.frame_ = requestAnimationFrame(draw);
  }

  /** Draws the next frame without the usual delay, because the visible frame is wrong. */
  hurry(): void { this.hurried_ = true; }

  /** Allows or forbids turning the view by dragging. */
  enable_turning(yes: boolean): void { this.viewpoint_.enable_turning(yes); }

  /**
   * Requests a frame in full quality, and resolves after it is drawn. The quality stays full until
   * something moves.
   */
  drawn(): Promise<void> {
    this.whole_ = true;
    return new Promise((done) => {
      this.waiting_.push(done);
      this.invalidate();
    });
  }

  /**
   * Returns the ray from the camera through a point of the page, given in px from the view's top
   * left.
   */
  sight(x_px: number, y_px: number): THREE.Raycaster {
    const { clientWidth: width, clientHeight: height } = this.host_;
    const caster = new THREE.Raycaster();
    caster.params.Line.threshold = 0.002;  // in meters; three's default is one meter
    caster.setFromCamera(new THREE.Vector2((2 * x_px) / width - 1, 1 - (2 * y_px) / height), this.camera);
    return caster;
  }

  /**
   * Returns the position of a point of the world frame on the page, in px from the view's top left.
   * Null if the point is behind the camera.
   */
  to_page(p_W: THREE.Vector3): { x: number; y: number } | null {
    const p = p_W.clone().project(this.camera);
    if (p.z > 1) return null;
    return { x: ((p.x + 1) / 2) * this.host_.clientWidth, y: ((1 - p.y) / 2) * this.host_.clientHeight };
  }

  private give_way(): void {
    if (this.pace_.disturbs) this.next_at_ms_ = Math.max(this.next_at_ms_, performance.now() + kAnswer_ms);
  }

  private draw(): void {
    this.drawn_at_ms_ = performance.now();
    this.hurried_ = false;
    this.pictures_ += 1;
    // The canvas is resized only now, because a resized canvas is empty until the next frame, which
    // may be late.
    if (this.resized_) this.renderer_.setSize(this.host_.clientWidth, this.host_.clientHeight);
    this.resized_ = false;
    const paced = this.waiting_.length === 0 && !this.at_rest_ && !this.whole_ && !wants_fine_picture();
    this.show_level(paced ? this.pace_.level : kLevels[0]);
    this.at_rest_ = false;
    this.refine_later();
    if (this.shapes_moved_ && this.shown_?.fine) {
      this.renderer_.shadowMap.needsUpdate = true;
      this.shapes_moved_ = false;
    }
    show_finish(this.scene, this.shown_?.fine ?? true);
    this.renderer_.render(this.scene, this.camera);
    this.after_draw();
    this.fence_.put(this.drawn_at_ms_, (took_ms) => {
      // Counts from when the frame was due, if it was only slightly late. Animation frames are
      // never exactly in time, and the delays would add up.
      const due_ms = Math.max(this.next_at_ms_, this.drawn_at_ms_ - kLate_ms);
      this.next_at_ms_ = due_ms + (paced ? this.pace_.took(took_ms) : kShareOfWhole * took_ms);
    });
    for (const tell of this.waiting_.splice(0)) tell();
  }

  /** Draws one more frame in full quality when everything has been at rest for a while. */
  private refine_later(): void {
    if (this.rest_timer_ !== null) clearTimeout(this.rest_timer_);
    this.rest_timer_ = this.shown_ === kLevels[0] ? null : window.setTimeout(() => {
      this.rest_timer_ = null;
      if (this.frame_ !== null) return;  // a frame is requested already, because something moves
      this.at_rest_ = true;
      this.invalidate(true);
    }, kRest_ms);
  }

  private show_level(level: Level | undefined): void {
    if (!level || level === this.shown_) return;
    this.shown_ = level;
    this.renderer_.setPixelRatio(this.full_ratio_ * level.resolution);
    this.on_level(level);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host_;
    if (width === 0 || height === 0) return;
    this.resized_ = true;
    this.viewpoint_.fit({ width, height }, this.covered_px_);
    this.invalidate(true);
  }
}
