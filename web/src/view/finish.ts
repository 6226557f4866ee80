// A surface in two qualities. The fine quality is lit per pixel and has shadows. The quick quality
// is for software rendering: it is lit per vertex and has fewer vertices. With software rendering a
// fine frame of two arms takes about 170 ms, a quick frame a tenth of that.

import * as THREE from 'three';

export interface Finish { geometry: THREE.BufferGeometry; material: THREE.Material }

/** A mesh that can be drawn in either quality. It is fine at first. */
export class FinishedMesh extends THREE.Mesh {
  constructor(readonly fine: Finish, readonly quick: Finish) {
    super(fine.geometry, fine.material);
  }

  /** Returns a copy that shares shape and materials, until one of them is painted. */
  override clone(): this {
    return new FinishedMesh({ ...this.fine }, { ...this.quick }).copy(this) as this;
  }

  /** Sets own materials. Does not dispose of the old materials, because other meshes share them. */
  wear(fine: THREE.Material, quick: THREE.Material): void {
    this.fine.material = fine;
    this.quick.material = quick;
    this.finish(true);
  }

  finish(fine: boolean): void {
    const { geometry, material } = fine ? this.fine : this.quick;
    this.geometry = geometry;
    this.material = material;
  }

  /** Replaces both materials and disposes of the old ones. */
  paint(fine: THREE.Material, quick: THREE.Material): void {
    for (const finish of [this.fine, this.quick]) finish.material.dispose();
    this.wear(fine, quick);
  }

  dispose(): void {
    for (const { geometry, material } of [this.fine, this.quick]) {
      geometry.dispose();
      material.dispose();
    }
  }
}

/** Sets the quality of all visible meshes below `root`. */
export function show_finish(root: THREE.Object3D, fine: boolean): void {
  root.traverseVisible((node) => { if (node instanceof FinishedMesh) node.finish(fine); });
}

// Computes lighting, tone mapping and sRGB for each vertex, with three's functions. The fragment
// shader only interpolates.
const kVertexShader = /* glsl */ `
uniform vec3 diffuse;
uniform vec3 emissive;
varying vec3 vShade;
#include <common>
#include <lights_pars_begin>
#include <tonemapping_pars_fragment>
#include <colorspace_pars_fragment>
void main() {
  vec3 normal_V = normalize(normalMatrix * normal);
  vec3 irradiance = ambientLightColor;
  #pragma unroll_loop_start
  for (int i = 0; i < NUM_DIR_LIGHTS; i++) {
    irradiance += saturate(dot(normal_V, directionalLights[i].direction)) * directionalLights[i].color;
  }
  #pragma unroll_loop_end
  #pragma unroll_loop_start
  for (int i = 0; i < NUM_HEMI_LIGHTS; i++) {
    irradiance += getHemisphereLightIrradiance(hemisphereLights[i], normal_V);
  }
  #pragma unroll_loop_end
  vec3 shade = diffuse;
  #ifdef USE_COLOR
    shade *= color;
  #endif
  shade = ACESFilmicToneMapping(shade * irradiance * RECIPROCAL_PI + emissive);
  vShade = sRGBTransferOETF(vec4(shade, 1.0)).rgb;
  gl_Position = projectionMatrix * (modelViewMatrix * vec4(position, 1.0));
}`;

const kFragmentShader = /* glsl */ `
uniform float opacity;
varying vec3 vShade;
void main() {
  gl_FragColor = vec4(vShade, opacity);
}`;

/**
 * Returns the quick version of a fine material. Both share their colors, so a later change of a
 * color applies to both.
 */
export function quick_material(fine: THREE.MeshStandardMaterial): THREE.ShaderMaterial {
  const quick = new THREE.ShaderMaterial({
    vertexShader: kVertexShader, fragmentShader: kFragmentShader, lights: true,
    uniforms: THREE.UniformsUtils.clone(THREE.UniformsLib.lights),
    vertexColors: fine.vertexColors, transparent: fine.transparent, opacity: fine.opacity, depthWrite: fine.depthWrite,
    polygonOffset: fine.polygonOffset, polygonOffsetFactor: fine.polygonOffsetFactor, polygonOffsetUnits: fine.polygonOffsetUnits,
  });
  Object.assign(quick.uniforms, { diffuse: { value: fine.color }, emissive: { value: fine.emissive }, opacity: { value: fine.opacity } });
  return quick;
}
