import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { FinishedMesh } from '../src/view/finish';
import { give_skin } from '../src/view/skin';

function link(): THREE.Group {
  const [fine, quick] = [new THREE.BoxGeometry(), new THREE.BoxGeometry()];
  const mesh = new FinishedMesh({ geometry: fine, material: new THREE.MeshStandardMaterial() }, { geometry: quick, material: new THREE.ShaderMaterial() });
  mesh.position.x = 0.3;
  const link = new THREE.Group();
  link.add(mesh);
  return link;
}

const mesh_of = (link: THREE.Group) => link.children[0] as FinishedMesh;

describe('Equal robots', () => {
  it('share their shapes in both qualities', () => {
    const pattern = link();
    const copy = pattern.clone();
    expect(mesh_of(copy)).toBeInstanceOf(FinishedMesh);
    expect(mesh_of(copy).fine.geometry).toBe(mesh_of(pattern).fine.geometry);
    expect(mesh_of(copy).quick.geometry).toBe(mesh_of(pattern).quick.geometry);
    expect(mesh_of(copy).position.x).toBe(0.3);
  });
  it('have their own materials', () => {
    const pattern = link();
    const [one, other] = [pattern.clone(), pattern.clone()];
    const skin = give_skin(one as never);
    give_skin(other as never);
    skin.emissive.set(0xff0000);
    expect(mesh_of(one).fine.material).toBe(skin);
    expect((mesh_of(other).fine.material as THREE.MeshStandardMaterial).emissive.getHex()).toBe(0);
    mesh_of(one).finish(false);
    expect(mesh_of(one).material).toBe(mesh_of(one).quick.material);
    expect(mesh_of(other).material).toBe(mesh_of(other).fine.material);
  });
});
