// Removes triangles that lie within another primitive of the same link. Half of each end sphere of
// a capsule, for example, lies within its cylinder. Primitives are convex, so a triangle lies
// within a primitive if its three corners do.

import type * as THREE from 'three';
import { Vector3 } from 'three';

/**
 * Returns true if a point lies within the primitive as it is drawn. The point is in the frame of
 * the primitive.
 */
export type Inside = (p: THREE.Vector3) => boolean;

/**
 * Tests against a unit sphere. Drawn spheres and cylinders are inscribed in the exact shape, so
 * only the share `filled` of the radius is inside.
 */
export function inside_sphere(filled: number): Inside {
  return (p) => p.lengthSq() < filled * filled;
}

/** Tests against a cylinder of unit radius and unit height along y. */
export function inside_cylinder(filled: number): Inside {
  return (p) => p.x * p.x + p.z * p.z < filled * filled && Math.abs(p.y) < kHalf;
}

export function inside_box(p: THREE.Vector3): boolean {
  return Math.abs(p.x) < kHalf && Math.abs(p.y) < kHalf && Math.abs(p.z) < kHalf;
}

// Half the size of a unit shape, slightly reduced so that faces that touch are kept.
const kHalf = 0.499;

/**
 * A primitive of a link. `X_SL` maps points from the link frame L to the frame S of the primitive.
 */
export interface Solid { X_SL: THREE.Matrix4; inside: Inside }

/**
 * Removes the triangles that lie within one of the solids. Changes and returns `geometry`. A
 * geometry without an index is returned unchanged.
 */
export function without_hidden(geometry: THREE.BufferGeometry, solids: readonly Solid[]): THREE.BufferGeometry {
  const index = geometry.index;
  if (!index || solids.length === 0) return geometry;
  const places = geometry.getAttribute('position');
  const p = new Vector3();
  const within = Array.from({ length: places.count }, (_, i) =>
    solids.map(({ X_SL, inside }) => inside(p.fromBufferAttribute(places, i).applyMatrix4(X_SL))));
  const kept: number[] = [];
  for (let i = 0; i + 3 <= index.count; i += 3) {
    const corners = [index.getX(i), index.getX(i + 1), index.getX(i + 2)];
    if (!solids.some((_, s) => corners.every((corner) => within[corner]?.[s]))) kept.push(...corners);
  }
  geometry.setIndex(kept);
  return geometry;
}
