// The camera of the 3D view. It shows the whole cell next to the part that the pane covers, until
// the user moves the camera.

import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Camera } from '../route/address';
import { distance_for, type Opening } from './framing';
import { is_same, kLowest_rad, kNearest_m, stepped, type CameraStep } from './steer';

const kMargin = 1.06;
const kMostCovered = 0.75;
const kDirection = new THREE.Vector3(0.16, -1, 0.4).normalize();

export class Viewpoint {
  readonly camera = new THREE.PerspectiveCamera(26, 1, 0.05, 60);
  readonly fog = new THREE.Fog(0x000000, 5, 14);
  /**
   * Called when the user moved the camera. Null means that the camera is back in the default view.
   */
  on_camera: (camera: Camera | null) => void = () => {};

  private readonly controls_: OrbitControls;
  private shown_box_ = new THREE.Box3(new THREE.Vector3(-1, -1, 0), new THREE.Vector3(1, 1, 1));
  private covered_px_ = 0;
  private size_px_ = { width: 1, height: 1 };
  private moved_by_user_ = false;

  /** `changed` is called after each move of the camera. */
  constructor(canvas: HTMLCanvasElement, changed: () => void) {
    this.controls_ = new OrbitControls(this.camera, canvas);
    this.controls_.maxPolarAngle = kLowest_rad;
    this.controls_.minDistance = kNearest_m;
    let before = this.now;
    this.controls_.addEventListener('start', () => { before = this.now; });
    this.controls_.addEventListener('end', () => {
      if (is_same(before, this.now)) return;  // only a click: the camera did not move
      this.moved_by_user_ = true;
      this.on_camera(this.now);
    });
    this.controls_.addEventListener('change', () => {
      this.fit_depth();
      changed();
    });
  }

  get now(): Camera {
    const { position } = this.camera;
    const { target } = this.controls_;
    return [position.x, position.y, position.z, target.x, target.y, target.z];
  }

  /**
   * Sets the box that the default view shows. `radius_m` limits how far away the camera can be
   * moved.
   */
  frame(box: THREE.Box3, radius_m: number): void {
    this.shown_box_ = box.clone();
    this.controls_.maxDistance = Math.max(12, 8 * radius_m);
    this.camera.far = 12 * this.controls_.maxDistance;
  }

  /** Moves the camera. Returns true if it moved. */
  show(camera: Camera): boolean {
    if (is_same(camera, this.now)) return false;
    this.moved_by_user_ = true;
    this.camera.position.set(camera[0], camera[1], camera[2]);
    this.controls_.target.set(camera[3], camera[4], camera[5]);
    this.controls_.update();
    return true;
  }

  /** Moves the camera by one step, for a button or a key. */
  steer(step: CameraStep): void {
    if (step === 'whole') this.look_from_default();
    else this.show(stepped(this.now, step));
    this.moved_by_user_ = step !== 'whole';
    this.on_camera(this.moved_by_user_ ? this.now : null);
  }

  /** Allows or forbids turning the view by dragging. */
  enable_turning(yes: boolean): void { this.controls_.enabled = yes; }

  close(): void { this.controls_.dispose(); }

  /**
   * Fits the view to its size. `covered_px` at the left are covered: the cell is centered in the
   * rest, and made smaller if needed.
   */
  fit(size_px: { width: number; height: number }, covered_px: number): void {
    const { width, height } = size_px;
    this.size_px_ = size_px;
    // If nearly all of the view is covered, the view is fitted as if nothing were.
    this.covered_px_ = covered_px < kMostCovered * width ? covered_px : 0;
    this.camera.aspect = width / height;
    // Only zoom and offset change, not the camera. So a camera in an address means the same with
    // and without a pane.
    this.camera.zoom = this.distance_through(0) / this.distance_through(this.covered_px_);
    this.camera.setViewOffset(width, height, -this.covered_px_ / 2, 0, width, height);
    this.camera.updateProjectionMatrix();
    if (!this.moved_by_user_) this.look_from_default();
  }

  /** Returns tangents of half the angles of the part that is not covered. */
  private opening(covered_px: number): Opening {
    const { width, height } = this.size_px_;
    const up = Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2));
    return { across: up * Math.max(0.2, (width - covered_px) / height), up };
  }

  /** Returns the camera distance of the default view, for the part that is not covered. */
  private distance_through(covered_px: number): number {
    return kMargin * distance_for(this.shown_box_, kDirection, this.opening(covered_px));
  }

  private look_from_default(): void {
    const middle = this.shown_box_.getCenter(new THREE.Vector3());
    this.camera.position.copy(middle).addScaledVector(kDirection, this.distance_through(0));
    this.controls_.target.copy(middle);
    this.controls_.update();
    this.fit_depth();
  }

  /** Moves the fog so that it begins behind the cell, at any distance of the camera. */
  private fit_depth(): void {
    const distance = this.camera.position.distanceTo(this.controls_.target);
    const depth = this.shown_box_.getSize(new THREE.Vector3()).length();
    this.fog.near = distance + 0.7 * depth;
    this.fog.far = 2 * distance + 4 * depth;
    this.camera.updateProjectionMatrix();
  }
}
