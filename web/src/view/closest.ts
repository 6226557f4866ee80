// Finds the closest points of two triangle surfaces, by alternating projection. The result is exact
// for convex surfaces and approximate for others. It is for drawing only, never a proof of
// clearance.

import * as THREE from 'three';

const kMostTriangles = 3000;
const kSteps = 24;
const kStill_m = 1e-5;

/**
 * A surface: nine numbers for each triangle (three corners), in the frame that `X_W` places in the
 * world.
 */
export interface Surface { corners: Float32Array; X_W: THREE.Matrix4 }

/** Returns the triangles of a mesh. If there are very many, returns every n-th triangle. */
export function corners_of(geometry: THREE.BufferGeometry): Float32Array {
  const plain = geometry.index ? geometry.toNonIndexed() : geometry;
  const place = plain.getAttribute('position');
  const count = Math.floor(place.count / 3);
  const step = Math.max(1, Math.ceil(count / kMostTriangles));
  const corners: number[] = [];
  for (let i = 0; i < count; i += step) {
    for (let k = 3 * i; k < 3 * i + 3; k++) corners.push(place.getX(k), place.getY(k), place.getZ(k));
  }
  return new Float32Array(corners);
}

/**
 * Returns one point of each surface, in the world frame. Returns null if a surface has no triangle.
 */
export function closest_points(a: Surface, b: Surface): [THREE.Vector3, THREE.Vector3] | null {
  if (a.corners.length === 0 || b.corners.length === 0) return null;
  let best: [THREE.Vector3, THREE.Vector3] | null = null;
  let best_m = Infinity;
  // Tries two start points, because one alone may end on the wrong side of a nonconvex link.
  for (const begin of [middle(b), corner(a)]) {
    let p = nearest(a, begin);
    let q = nearest(b, p);
    for (let step = 0; step < kSteps; step++) {
      const next = nearest(a, q);
      const moved_m = next.distanceTo(p);
      p = next;
      q = nearest(b, p);
      if (moved_m < kStill_m) break;
    }
    const apart_m = p.distanceTo(q);
    if (apart_m < best_m) [best, best_m] = [[p, q], apart_m];
  }
  return best;
}

function corner({ corners, X_W }: Surface): THREE.Vector3 {
  return new THREE.Vector3(corners[0], corners[1], corners[2]).applyMatrix4(X_W);
}

function middle({ corners, X_W }: Surface): THREE.Vector3 {
  const sum = new THREE.Vector3();
  for (let i = 0; i < corners.length; i += 3) sum.add(new THREE.Vector3(corners[i], corners[i + 1], corners[i + 2]));
  return sum.divideScalar(Math.max(1, corners.length / 3)).applyMatrix4(X_W);
}

const triangle = new THREE.Triangle();
const candidate = new THREE.Vector3();

function nearest({ corners, X_W }: Surface, to_W: THREE.Vector3): THREE.Vector3 {
  const to = to_W.clone().applyMatrix4(X_W.clone().invert());
  const found = new THREE.Vector3();
  let least = Infinity;
  for (let i = 0; i + 9 <= corners.length; i += 9) {
    triangle.a.fromArray(corners, i);
    triangle.b.fromArray(corners, i + 3);
    triangle.c.fromArray(corners, i + 6);
    triangle.closestPointToPoint(to, candidate);
    const away = candidate.distanceToSquared(to);
    if (away < least) {
      least = away;
      found.copy(candidate);
    }
  }
  return found.applyMatrix4(X_W);
}
