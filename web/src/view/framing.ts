// Finds how far away the camera must be to show a whole box.

import * as THREE from 'three';
import type { Cell } from '../server/messages';

/**
 * The part of the view that the pane leaves free, as tangents of half its horizontal and vertical
 * angle.
 */
export interface Opening { across: number; up: number }

/**
 * Returns the least camera distance from the box's center at which the whole box is visible.
 * `direction` is the unit vector from the center to the camera. z is up.
 */
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

// Margins around the bases: horizontally slightly less than an arm's reach, vertically the usual
// working height.
const kReach_m = 0.46;
const kHeight_m = 0.85;

/** Returns the box in which the arms usually work, or null if the cell has no robots. */
export function box_around_bases(cell: Cell): THREE.Box3 | null {
  const box = new THREE.Box3();
  for (const robot of cell.robots) box.expandByPoint(new THREE.Vector3(...robot.base.xyz));
  if (box.isEmpty()) return null;
  box.expandByVector(new THREE.Vector3(kReach_m, kReach_m, 0));
  box.max.z += kHeight_m;
  return box;
}
