// Meshes of scene objects. Poses are as in URDF: meters, and roll, pitch, yaw about the fixed axes
// x, y, z.

import * as THREE from 'three';
import { FinishedMesh, quick_material } from './finish';
import { shape_of, type SceneObject, type Shape } from '../server/messages';

export function place(object: THREE.Object3D, xyz: readonly number[], rpy: readonly number[]): void {
  object.position.set(xyz[0] ?? 0, xyz[1] ?? 0, xyz[2] ?? 0);
  // Rotations about the fixed axes x, y, z equal rotations about the moving axes z, y, x, which is
  // three's order 'ZYX'.
  object.rotation.set(rpy[0] ?? 0, rpy[1] ?? 0, rpy[2] ?? 0, 'ZYX');
}

/**
 * Returns the drawn object with its edges, or null if its shape cannot be drawn. `surface` is the
 * content of the object's mesh file. If it is null, a mesh object is drawn as a marker.
 */
export function object_mesh(object: SceneObject, surface: THREE.BufferGeometry | null = null): THREE.Object3D | null {
  const shape = shape_of(object);
  if (!shape) return null;
  const geometry = shape.kind === 'mesh'
    ? scaled(surface ?? mark_geometry(), surface ? shape.scale : [1, 1, 1])
    : shape_geometry(shape);
  const material = new THREE.MeshStandardMaterial({ roughness: 0.85, metalness: 0 });
  const mesh = new FinishedMesh({ geometry, material }, { geometry, material: quick_material(material) });
  mesh.name = object.name;
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  const edges = new THREE.LineSegments(
    new THREE.EdgesGeometry(geometry, 30),
    new THREE.LineBasicMaterial({ color: 0x5b6776, transparent: true, opacity: 0.6 }),
  );
  mesh.add(edges);
  place(mesh, object.xyz, object.rpy);
  return mesh;
}

/** Returns the marker that is drawn in place of a mesh that cannot be read. */
export function mark_geometry(): THREE.BufferGeometry {
  return new THREE.OctahedronGeometry(0.06);
}

function scaled(geometry: THREE.BufferGeometry, [x, y, z]: readonly [number, number, number]): THREE.BufferGeometry {
  const copy = geometry.clone().applyMatrix4(new THREE.Matrix4().makeScale(x, y, z));
  return x * y * z < 0 ? turned_inside_out(copy) : copy;
}

/**
 * Swaps two corners of each triangle. After a mirroring, the triangles would otherwise face inward.
 */
export function turned_inside_out(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const plain = geometry.index ? geometry.toNonIndexed() : geometry;
  for (const attribute of Object.values(plain.attributes)) {
    const size = attribute.itemSize;
    const array = attribute.array;
    for (let i = 0; i + 3 * size <= array.length; i += 3 * size) {
      for (let k = 0; k < size; k++) {
        const second = array[i + size + k] ?? 0;
        array[i + size + k] = array[i + 2 * size + k] ?? 0;
        array[i + 2 * size + k] = second;
      }
    }
  }
  return plain;
}

function shape_geometry(shape: Exclude<Shape, { kind: 'mesh' }>): THREE.BufferGeometry {
  switch (shape.kind) {
    case 'box': return new THREE.BoxGeometry(...shape.size);
    // three's cylinder is along y. A cylinder of the scene is along z.
    case 'cylinder': return new THREE.CylinderGeometry(shape.radius, shape.radius, shape.length, 40).rotateX(Math.PI / 2);
    case 'sphere': return new THREE.SphereGeometry(shape.radius, 32, 20);
  }
}

export function dispose(root: THREE.Object3D): void {
  root.traverse((node) => {
    if (node instanceof FinishedMesh) return node.dispose();
    if (!(node instanceof THREE.Mesh || node instanceof THREE.LineSegments)) return;
    (node.geometry as THREE.BufferGeometry).dispose();
    const materials = [node.material].flat() as THREE.Material[];
    for (const material of materials) material.dispose();
  });
}
