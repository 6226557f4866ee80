// Triangles that nobody can see, because they lie within another primitive of the same link: half of the
// spheres at the ends of a URDF's capsules. A primitive is convex, so that a triangle lies within it when
// its corners do.

import type * as THREE from 'three';
import { Vector3 } from 'three';

/** Which points lie within a primitive as it is drawn, in its own frame; null: not a primitive that is known. */
export type Inside = (p: THREE.Vector3) => boolean;

/** What is drawn of a round one lies within it: so much of the radius is surely filled. */
export function inside_sphere(filled: number): Inside {
  return (p) => p.lengthSq() < filled * filled;
}

/** Along y, a unit high. */
export function inside_cylinder(filled: number): Inside {
  return (p) => p.x * p.x + p.z * p.z < filled * filled && Math.abs(p.y) < kHalf;
}

export function inside_box(p: THREE.Vector3): boolean {
  return Math.abs(p.x) < kHalf && Math.abs(p.y) < kHalf && Math.abs(p.z) < kHalf;
}

// Faces that only touch are both kept.
const kHalf = 0.499;

/** A solid in the frame L: points of L are taken into its own. */
export interface Solid { X_SL: THREE.Matrix4; inside: Inside }

/** Leaves out, in place, the triangles that lie within one of the solids. Only of geometries with an index. */
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
