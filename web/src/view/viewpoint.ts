// Where the camera of the 3D view stands: so that all is seen beside what is covered, until somebody moves it.

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
  /** Told when the user has turned or moved the camera; null: it stands as at first. */
  on_camera: (camera: Camera | null) => void = () => {};

  private readonly controls_: OrbitControls;
  private shown_box_ = new THREE.Box3(new THREE.Vector3(-1, -1, 0), new THREE.Vector3(1, 1, 1));
  private covered_px_ = 0;
  private size_px_ = { width: 1, height: 1 };
  private moved_by_user_ = false;

  /** `changed`: it has moved, by hand or else. */
  constructor(canvas: HTMLCanvasElement, changed: () => void) {
    this.controls_ = new OrbitControls(this.camera, canvas);
    this.controls_.maxPolarAngle = kLowest_rad;
    this.controls_.minDistance = kNearest_m;
    let before = this.now;
    this.controls_.addEventListener('start', () => { before = this.now; });
    this.controls_.addEventListener('end', () => {
      if (is_same(before, this.now)) return;  // it was a click
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

  /** Looks at a box so that it fills the view; kept until the user turns it. */
  frame(box: THREE.Box3, radius_m: number): void {
    this.shown_box_ = box.clone();
    this.controls_.maxDistance = Math.max(12, 8 * radius_m);
    this.camera.far = 12 * this.controls_.maxDistance;
  }

  /** As an address has it. Answers whether it was another one. */
  show(camera: Camera): boolean {
    if (is_same(camera, this.now)) return false;
    this.moved_by_user_ = true;
    this.camera.position.set(camera[0], camera[1], camera[2]);
    this.controls_.target.set(camera[3], camera[4], camera[5]);
    this.controls_.update();
    return true;
  }

  /** The user's, by a button or a key. */
  steer(step: CameraStep): void {
    if (step === 'whole') this.look_from_default();
    else this.show(stepped(this.now, step));
    this.moved_by_user_ = step !== 'whole';
    this.on_camera(this.moved_by_user_ ? this.now : null);
  }

  /** Whether a drag turns the view. */
  let_turn(yes: boolean): void { this.controls_.enabled = yes; }

  close(): void { this.controls_.dispose(); }

  /** So many pixels, and so many of them at the left covered: the middle of the picture goes to the middle of the rest, as small as it needs. */
  fit(size_px: { width: number; height: number }, covered_px: number): void {
    const { width, height } = size_px;
    this.size_px_ = size_px;
    // Under what covers nearly all it stays as it is.
    this.covered_px_ = covered_px < kMostCovered * width ? covered_px : 0;
    this.camera.aspect = width / height;
    // The camera stays where it is, so that an address means the same with a pane and without.
    this.camera.zoom = this.distance_through(0) / this.distance_through(this.covered_px_);
    this.camera.setViewOffset(width, height, -this.covered_px_ / 2, 0, width, height);
    this.camera.updateProjectionMatrix();
    if (!this.moved_by_user_) this.look_from_default();
  }

  /** Tangents of the half angles under which the part that is not covered is seen. */
  private opening(covered_px: number): Opening {
    const { width, height } = this.size_px_;
    const up = Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2));
    return { across: up * Math.max(0.2, (width - covered_px) / height), up };
  }

  /** From where all is seen beside what is covered. */
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

  /** Fog begins behind what is looked at, however far away that is. */
  private fit_depth(): void {
    const distance = this.camera.position.distanceTo(this.controls_.target);
    const depth = this.shown_box_.getSize(new THREE.Vector3()).length();
    this.fog.near = distance + 0.7 * depth;
    this.fog.far = 2 * distance + 4 * depth;
    this.camera.updateProjectionMatrix();
  }
}
