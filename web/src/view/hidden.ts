// Removes triangles that lie within another primitive of the same link, such as half of the end
// spheres of capsules. Primitives are convex, so a triangle lies within one if its corners do.

import type * as THREE from 'three';
import { Vector3 } from 'three';

/** Returns true if a point, in the primitive's frame, lies within the primitive as drawn. */
export type Inside = (p: THREE.Vector3) => boolean;

/** Drawn round shapes are inscribed: only this share of the radius is filled. */
export function inside_sphere(filled: number): Inside {
  return (p) => p.lengthSq() < filled * filled;
}

/** Along y, unit height. */
export function inside_cylinder(filled: number): Inside {
  return (p) => p.x * p.x + p.z * p.z < filled * filled && Math.abs(p.y) < kHalf;
}

export function inside_box(p: THREE.Vector3): boolean {
  return Math.abs(p.x) < kHalf && Math.abs(p.y) < kHalf && Math.abs(p.z) < kHalf;
}

// Slightly less than half: touching faces are kept.
const kHalf = 0.499;

/** A solid in frame L; X_SL maps points from L to the solid. */
export interface Solid { X_SL: THREE.Matrix4; inside: Inside }

/** Removes the triangles within one of the solids, in place. The geometry must have an index. */
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
