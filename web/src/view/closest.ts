// The closest points of two triangle surfaces, by alternating projection. Exact for convex
// surfaces, approximate for others: for drawing only, never as a proof.

import * as THREE from 'three';

const kMostTriangles = 3000;
const kSteps = 24;
const kStill_m = 1e-5;

/** Three corners per triangle, in the frame of `X_W`. */
export interface Surface { corners: Float32Array; X_W: THREE.Matrix4 }

/** Returns a mesh's triangles; a sample if there are very many. */
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

/** Returns the points in the world, or null if a surface has no triangle. */
export function closest_points(a: Surface, b: Surface): [THREE.Vector3, THREE.Vector3] | null {
  if (a.corners.length === 0 || b.corners.length === 0) return null;
  let best: [THREE.Vector3, THREE.Vector3] | null = null;
  let best_m = Infinity;
  // Two start points, because one may end on the wrong side of a nonconvex link.
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
