// Antialiased halftone foam on a standard material of three.js, lit by the scene: addFoam(material, await loadMask()).
import { DataTexture, DataUtils, HalfFloatType, NearestFilter, NearestMipmapNearestFilter, RedFormat, RepeatWrapping } from "three";

export async function loadMask(url = "mask.u16", width = 256, height = 256) {
  const values = new Uint16Array(await (await fetch(url)).arrayBuffer());
  const halves = Uint16Array.from(values, (value) => DataUtils.toHalfFloat(value / 65535));
  const mask = new DataTexture(halves, width, height, RedFormat, HalfFloatType);
  mask.wrapS = mask.wrapT = RepeatWrapping;
  mask.generateMipmaps = mask.needsUpdate = true;
  return Object.assign(mask, { magFilter: NearestFilter, minFilter: NearestMipmapNearestFilter });
}

const FOAM = `uniform highp sampler2D u_mask;
const float SPREAD[11] = float[11](0.0, 0.404, 0.471, 0.493, 0.499, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5);
float foam(float saturation, vec2 uv) {
  vec2 dx = dFdx(uv), dy = dFdy(uv), size = vec2(textureSize(u_mask, 0));
  float side = 0.25 * sqrt(abs(dx.x * dy.y - dx.y * dy.x) * size.x * size.y);
  int level = int(clamp(floor(log2(max(side, 1e-6)) + 0.5), 0.0, 10.0));
  float tilt = clamp(6.0 * SPREAD[level] - 1.5, 0.0, 1.0), bend = 6.0 * saturation * (1.0 - saturation), covered = 0.0;
  for (int i = 0; i < 16; i++) {
    vec2 at = uv + dx * (float(i & 3) - 1.5) / 4.0 + dy * (float(i >> 2) - 1.5) / 4.0;
    float mean = textureLod(u_mask, at, float(level)).r * (65535.0 / 65536.0) + 0.5 / 65536.0;
    float spread = max(min(SPREAD[level], min(mean, 1.0 - mean)), 1e-6);
    float even = clamp(0.5 + 0.5 * (saturation - mean) / spread, 0.0, 1.0);
    covered += mix(even, clamp(saturation - bend * (mean - 0.5), 0.0, 1.0), tilt);
  }
  return covered / 16.0;
}`;

// saturation: GLSL, 0 to 1, of vUv and the material's varyings; tiles: repeats of the mask over the surface.
export function addFoam(material, mask, saturation = "0.3", tiles = 8) {
  material.defines = { ...material.defines, USE_UV: "" };
  material.customProgramCacheKey = () => saturation + tiles;
  material.onBeforeCompile = (shader) => {
    shader.uniforms.u_mask = { value: mask };
    const colour = `diffuseColor.rgb = mix(diffuseColor.rgb, vec3(0.9), foam(${saturation}, vUv * float(${tiles})));`;
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", `${FOAM}\nvoid main() {`).replace("#include <color_fragment>", `#include <color_fragment>\n${colour}`);
  };
}
