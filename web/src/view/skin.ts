// Turns the many primitives of a URDF's links into one mesh per link.
//
// A Panda is eighty primitives; drawn one by one, with shadows, they cost more than anything else
// on the page, above all without a graphics card. Colours go into the vertices, so that a link is
// one draw call, and curved primitives get no more triangles than their size on the screen needs.

import * as THREE from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import type { URDFRobot } from 'urdf-loader';
import { turned_inside_out } from './shapes';

// urdf-loader builds every sphere and cylinder with unit size and scales the mesh.
const kSphere = new THREE.SphereGeometry(1, 20, 12);
const kCylinder = new THREE.CylinderGeometry(1, 1, 1, 24);

/** Replaces the primitives of each link by one mesh; answers the skin that all of them share. */
export function merge_links(robot: URDFRobot): THREE.MeshStandardMaterial {
  const skin = new THREE.MeshStandardMaterial({ vertexColors: true, roughness: 0.5, metalness: 0.05 });
  robot.updateMatrixWorld(true);
  for (const link of Object.values(robot.links)) {
    const parts = meshes_of(link);
    const merged = parts.length ? mergeGeometries(alike(parts.map((part) => painted(part, link)))) : null;
    if (!merged) continue;
    for (const part of parts) part.removeFromParent();
    const mesh = new THREE.Mesh(merged, skin);
    mesh.castShadow = true;
    mesh.receiveShadow = true;
    link.add(mesh);
  }
  return skin;
}

/** The meshes that are rigid with a link: below it, but not beyond one of its joints. */
function meshes_of(link: THREE.Object3D): THREE.Mesh[] {
  const found: THREE.Mesh[] = [];
  const visit = (node: THREE.Object3D) => {
    if (node instanceof THREE.Mesh) found.push(node);
    for (const child of node.children) if (!('isURDFJoint' in child)) visit(child);
  };
  visit(link);
  return found;
}

/** A copy of the mesh's shape in the link's frame, with the mesh's colour in every vertex. */
function painted(mesh: THREE.Mesh, link: THREE.Object3D): THREE.BufferGeometry {
  const X_LM = link.matrixWorld.clone().invert().multiply(mesh.matrixWorld);
  const geometry = simpler(mesh.geometry).clone().applyMatrix4(X_LM);
  if (!geometry.hasAttribute('normal')) geometry.computeVertexNormals();
  for (const name of Object.keys(geometry.attributes)) {
    if (name !== 'position' && name !== 'normal') geometry.deleteAttribute(name);
  }
  geometry.morphAttributes = {};
  const material = [mesh.material].flat()[0] as THREE.MeshPhongMaterial;
  const count = geometry.getAttribute('position').count;
  const colours = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) material.color.toArray(colours, 3 * i);
  geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));
  return X_LM.determinant() < 0 ? turned_inside_out(geometry) : geometry;
}

/** Only geometries with an index, or only without one, can be merged: meshes of files have none. */
function alike(geometries: THREE.BufferGeometry[]): THREE.BufferGeometry[] {
  if (geometries.every((geometry) => geometry.index)) return geometries;
  return geometries.map((geometry) => (geometry.index ? geometry.toNonIndexed() : geometry));
}

function simpler(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  if (geometry instanceof THREE.SphereGeometry) return kSphere;
  if (geometry instanceof THREE.CylinderGeometry) return kCylinder;
  return geometry;
}
