// Detects software rendering, and the option `?fine` in the address, which asks for full quality.

export function wants_fine_picture(): boolean {
  return new URLSearchParams(window.location.search).has('fine');
}

export function renders_in_software(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  const names = gl?.getExtension('WEBGL_debug_renderer_info');
  const renderer = gl && names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|basic render/i.test(renderer);
}
