// How far a camera stands off so that a box is seen whole.

import * as THREE from 'three';
import type { Cell } from '../server/messages';

/** Half angles under which the free part of the picture is seen, as tangents. */
export interface Opening { across: number; up: number }

/** The least distance from the box's middle, along `direction` (a unit vector towards the camera; z is up). */
export function distance_for(box: THREE.Box3, direction: THREE.Vector3, opening: Opening): number {
  const middle = box.getCenter(new THREE.Vector3());
  const right = new THREE.Vector3(0, 0, 1).cross(direction).normalize();
  const up = new THREE.Vector3().crossVectors(direction, right);
  let distance = 0;
  for (let i = 0; i < 8; i++) {
    const corner = new THREE.Vector3(
      i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z,
    ).sub(middle);
    const nearer = corner.dot(direction);
    distance = Math.max(distance, Math.abs(corner.dot(right)) / opening.across + nearer, Math.abs(corner.dot(up)) / opening.up + nearer);
  }
  return distance;
}

// Around the bases: a little less than an arm's reach, and as high as arms at work are.
const kReach_m = 0.46;
const kHeight_m = 0.85;

/** Where arms work; null: there is none. */
export function box_around_bases(cell: Cell): THREE.Box3 | null {
  const box = new THREE.Box3();
  for (const robot of cell.robots) box.expandByPoint(new THREE.Vector3(...robot.base.xyz));
  if (box.isEmpty()) return null;
  box.expandByVector(new THREE.Vector3(kReach_m, kReach_m, 0));
  box.max.z += kHeight_m;
  return box;
}
