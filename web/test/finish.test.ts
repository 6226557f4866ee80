import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { FinishedMesh, quick_material, show_finish } from '../src/view/finish';
import { inside_box, inside_cylinder, inside_sphere, without_hidden } from '../src/view/hidden';

const kIdentity = new THREE.Matrix4();
const triangles = (geometry: THREE.BufferGeometry) => (geometry.index?.count ?? 0) / 3;

describe('Surface in two qualities', () => {
  const material = new THREE.MeshStandardMaterial({ color: 0x336699 });
  const fine = { geometry: new THREE.SphereGeometry(1, 20, 12), material };
  const quick = { geometry: new THREE.SphereGeometry(1, 12, 8), material: quick_material(material) };
  it('shows one of them, and only if visible', () => {
    const root = new THREE.Group();
    const [seen, hidden] = [new FinishedMesh(fine, quick), new FinishedMesh(fine, quick)];
    hidden.visible = false;
    root.add(seen, hidden);
    show_finish(root, false);
    expect([seen.geometry, seen.material]).toEqual([quick.geometry, quick.material]);
    expect(hidden.geometry).toBe(fine.geometry);
    show_finish(root, true);
    expect([seen.geometry, seen.material]).toEqual([fine.geometry, fine.material]);
  });
  it('has the same color in both, also after a change', () => {
    material.color.set(0xff0000);
    material.emissive.set(0x400000);
    expect(quick.material.uniforms['diffuse']?.value).toBe(material.color);
    expect(quick.material.uniforms['emissive']?.value).toBe(material.emissive);
  });
});

describe('Hidden triangles', () => {
  it('are removed where a sphere lies in a cylinder', () => {
    // The end of a capsule: half of the sphere is outside of the cylinder.
    const X_SL = new THREE.Matrix4().makeTranslation(0, 0.5, 0);  // the cylinder reaches from y = -1 to 0
    const sphere = without_hidden(new THREE.SphereGeometry(1, 20, 12), [{ X_SL, inside: inside_cylinder(0.99) }]);
    const all = triangles(new THREE.SphereGeometry(1, 20, 12));
    expect(triangles(sphere)).toBeGreaterThan(all / 2 - 1);
    expect(triangles(sphere)).toBeLessThan(0.9 * all);
    const places = sphere.getAttribute('position');
    const drawn = new Set(Array.from(sphere.index?.array ?? []));
    // The pole of the sphere at y = 1 is outside of the cylinder, so it stays.
    expect([...drawn].some((i) => places.getY(i) > 0.99)).toBe(true);
  });
  it('stay where shapes only touch, or one corner is outside', () => {
    const box = new THREE.BoxGeometry(1, 1, 1);
    expect(triangles(without_hidden(box.clone(), [{ X_SL: kIdentity, inside: inside_box }]))).toBe(12);
    expect(triangles(without_hidden(box.clone(), [{ X_SL: new THREE.Matrix4().makeTranslation(0.2, 0, 0), inside: inside_box }]))).toBe(12);
  });
  it('are removed completely if a body lies within another', () => {
    const small = new THREE.BoxGeometry(0.2, 0.2, 0.2);
    expect(triangles(without_hidden(small, [{ X_SL: kIdentity, inside: inside_sphere(0.98) }]))).toBe(0);
  });
  it('are not searched in meshes without an index', () => {
    const mesh = new THREE.BoxGeometry(0.2, 0.2, 0.2).toNonIndexed();
    expect(without_hidden(mesh, [{ X_SL: kIdentity, inside: inside_sphere(1) }]).getAttribute('position').count).toBe(36);
  });
});
