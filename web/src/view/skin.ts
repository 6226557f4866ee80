// Merges the primitives of each URDF link into one mesh.
//
// A Panda has eighty primitives. Drawn one by one with shadows, they would take most of the page's
// time, above all without a graphics card. Colors are stored in the vertices, so that a link is one
// draw call. Curved primitives get only as many triangles as needed. Triangles hidden inside
// another primitive are removed.

import * as THREE from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import type { URDFRobot } from 'urdf-loader';
import { FinishedMesh, quick_material } from './finish';
import { inside_box, inside_cylinder, inside_sphere, without_hidden, type Solid } from './hidden';
import { turned_inside_out } from './shapes';

// urdf-loader builds spheres and cylinders of unit size, and scales the mesh.
interface Rounds { sphere: THREE.SphereGeometry; cylinder: THREE.CylinderGeometry }
const kFine: Rounds = { sphere: new THREE.SphereGeometry(1, 20, 12), cylinder: new THREE.CylinderGeometry(1, 1, 1, 24) };
const kQuick: Rounds = { sphere: new THREE.SphereGeometry(1, 12, 8), cylinder: new THREE.CylinderGeometry(1, 1, 1, 14) };

/** Replaces the primitives of each link by one mesh. */
export function merge_links(robot: URDFRobot): void {
  const skin = make_skin();
  const quick_skin = quick_material(skin);
  robot.updateMatrixWorld(true);
  for (const link of Object.values(robot.links)) {
    const parts = meshes_of(link);
    const [fine, quick] = [merged(parts, link, kFine), merged(parts, link, kQuick)];
    if (!fine || !quick) continue;
    for (const part of parts) part.removeFromParent();
    const mesh = new FinishedMesh({ geometry: fine, material: skin }, { geometry: quick, material: quick_skin });
    mesh.castShadow = true;
    mesh.receiveShadow = true;
    link.add(mesh);
  }
}

/** Gives the robot its own material, which all its links share. Returns the material. */
export function give_skin(robot: URDFRobot): THREE.MeshStandardMaterial {
  const skin = make_skin();
  const quick_skin = quick_material(skin);
  robot.traverse((node) => { if (node instanceof FinishedMesh) node.wear(skin, quick_skin); });
  return skin;
}

function make_skin(): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({ vertexColors: true, roughness: 0.5, metalness: 0.05 });
}

/** Returns the visible surface of a link's primitives, in the link's frame. */
function merged(parts: readonly THREE.Mesh[], link: THREE.Object3D, rounds: Rounds): THREE.BufferGeometry | null {
  if (parts.length === 0) return null;
  const solids = parts.map((part) => solid_of(part, link, rounds));
  return mergeGeometries(alike(parts.map((part, i) =>
    without_hidden(painted(part, link, rounds), solids.flatMap((solid, k) => (solid && k !== i ? [solid] : []))))));
}

/** Returns the solid of a primitive. Null if the primitive is a mesh, which may be hollow. */
function solid_of(part: THREE.Mesh, link: THREE.Object3D, { sphere, cylinder }: Rounds): Solid | null {
  const inside = part.geometry instanceof THREE.SphereGeometry ? inside_sphere(filled(sphere.parameters.heightSegments) * filled(sphere.parameters.widthSegments / 2))
    : part.geometry instanceof THREE.CylinderGeometry ? inside_cylinder(filled(cylinder.parameters.radialSegments / 2))
    : part.geometry instanceof THREE.BoxGeometry ? inside_box : null;
  return inside && { X_SL: part.matrixWorld.clone().invert().multiply(link.matrixWorld), inside };
}

/**
 * Returns the share of the radius that a drawn circle fills, if half of the circle is drawn by this
 * many straight pieces.
 */
function filled(pieces: number): number {
  return Math.cos(Math.PI / 2 / pieces);
}

/**
 * Returns the meshes that are rigidly attached to a link. Meshes beyond the link's joints are left
 * out.
 */
function meshes_of(link: THREE.Object3D): THREE.Mesh[] {
  const found: THREE.Mesh[] = [];
  const visit = (node: THREE.Object3D) => {
    if (node instanceof THREE.Mesh) found.push(node);
    for (const child of node.children) if (!('isURDFJoint' in child)) visit(child);
  };
  visit(link);
  return found;
}

/** Returns a copy of the mesh in the link's frame, with the mesh's color in each vertex. */
function painted(mesh: THREE.Mesh, link: THREE.Object3D, rounds: Rounds): THREE.BufferGeometry {
  const X_LM = link.matrixWorld.clone().invert().multiply(mesh.matrixWorld);
  const geometry = simpler(mesh.geometry, rounds).clone().applyMatrix4(X_LM);
  if (!geometry.hasAttribute('normal')) geometry.computeVertexNormals();
  for (const name of Object.keys(geometry.attributes)) {
    if (name !== 'position' && name !== 'normal') geometry.deleteAttribute(name);
  }
  geometry.morphAttributes = {};
  const material = [mesh.material].flat()[0] as THREE.MeshPhongMaterial;
  const count = geometry.getAttribute('position').count;
  const colors = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) material.color.toArray(colors, 3 * i);
  geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3));
  return X_LM.determinant() < 0 ? turned_inside_out(geometry) : geometry;
}

/**
 * Returns the geometries in a form that can be merged: all with an index, or none. Meshes from
 * files have no index.
 */
function alike(geometries: THREE.BufferGeometry[]): THREE.BufferGeometry[] {
  if (geometries.every((geometry) => geometry.index)) return geometries;
  return geometries.map((geometry) => (geometry.index ? geometry.toNonIndexed() : geometry));
}

function simpler(geometry: THREE.BufferGeometry, { sphere, cylinder }: Rounds): THREE.BufferGeometry {
  if (geometry instanceof THREE.SphereGeometry) return sphere;
  if (geometry instanceof THREE.CylinderGeometry) return cylinder;
  return geometry;
}
