// Creates the renderer of the stage.

import * as THREE from 'three';

/** Returns the renderer. If `fine` is true, it smooths edges (antialiasing). */
export function make_renderer(fine: boolean): THREE.WebGLRenderer {
  const renderer = new THREE.WebGLRenderer({ antialias: fine, alpha: true, powerPreference: 'low-power' });
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  renderer.toneMappingExposure = 1.2;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFShadowMap;
  renderer.shadowMap.autoUpdate = false;
  renderer.debug.checkShaderErrors = false;  // the check would wait until the shaders are compiled
  return renderer;
}
