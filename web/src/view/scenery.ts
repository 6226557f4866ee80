// Lights and floor of the 3D view.

import * as THREE from 'three';
import { ink } from '../state/palette';

const kShadows = 0.7;

/** Adds the lights. Returns the light that casts shadows. */
export function add_lights(scene: THREE.Scene): THREE.DirectionalLight {
  scene.add(new THREE.HemisphereLight(0xe6edf7, 0x39404c, 1.7));
  const key = new THREE.DirectionalLight(0xfff6ea, 1.9);
  key.castShadow = true;
  key.shadow.mapSize.set(1024, 1024);
  key.shadow.radius = 5;
  key.shadow.normalBias = 0.02;
  key.shadow.intensity = kShadows;
  const rim = new THREE.DirectionalLight(0xa9c8f5, 0.7);
  rim.position.set(-2.5, 2.5, 1.6);
  scene.add(key, key.target, rim);
  return key;
}

/** Aims the light at `middle`. Shadows are cast within `reach_m` of this point. */
export function light_up(light: THREE.DirectionalLight, middle: THREE.Vector3, reach_m: number): void {
  light.target.position.copy(middle);
  light.position.copy(middle).add(new THREE.Vector3(0.55, -0.85, 2.1).multiplyScalar(1.2 * reach_m));
  const camera = light.shadow.camera;
  Object.assign(camera, { left: -reach_m, right: reach_m, top: reach_m, bottom: -reach_m, near: 0.1, far: 5 * reach_m });
  camera.updateProjectionMatrix();
}

export function floor(): THREE.Group {
  const [line, strong] = [new THREE.Color(ink('--grid')), new THREE.Color(ink('--grid-strong'))];
  const fine = new THREE.GridHelper(24, 96, line, line);
  const coarse = new THREE.GridHelper(24, 24, strong, strong);
  for (const grid of [fine, coarse]) grid.rotation.x = Math.PI / 2;
  fine.position.z = -0.003;
  coarse.position.z = -0.002;
  return new THREE.Group().add(fine, coarse);
}
