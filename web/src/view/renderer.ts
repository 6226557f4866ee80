// The renderer as the stage wants it.

import * as THREE from 'three';

/** `fine`: edges are smoothed. */
export function make_renderer(fine: boolean): THREE.WebGLRenderer {
  const renderer = new THREE.WebGLRenderer({ antialias: fine, alpha: true, powerPreference: 'low-power' });
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  renderer.toneMappingExposure = 1.2;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFShadowMap;
  renderer.shadowMap.autoUpdate = false;
  renderer.debug.checkShaderErrors = false;  // to ask is to wait until they are compiled
  return renderer;
}
