/** Textures from the plan's bytes, level by level. */
import type { Texture as TextureSpec } from "../generated/api";

const LAYOUTS = {
  R8: { channels: 1, pixels: Uint8Array, format: "RED", type: "UNSIGNED_BYTE" },
  R8UI: { channels: 1, pixels: Uint8Array, format: "RED_INTEGER", type: "UNSIGNED_BYTE" },
  R16UI: { channels: 1, pixels: Uint16Array, format: "RED_INTEGER", type: "UNSIGNED_SHORT" },
  RG32UI: { channels: 2, pixels: Uint32Array, format: "RG_INTEGER", type: "UNSIGNED_INT" },
  R16F: { channels: 1, pixels: Uint16Array, format: "RED", type: "HALF_FLOAT" },
  R32F: { channels: 1, pixels: Float32Array, format: "RED", type: "FLOAT" },
  RG32F: { channels: 2, pixels: Float32Array, format: "RG", type: "FLOAT" },
  RGBA32F: { channels: 4, pixels: Float32Array, format: "RGBA", type: "FLOAT" },
} as const satisfies Record<TextureSpec["format"], object>;

export function textureKey(spec: TextureSpec): string {
  return [spec.sha256, spec.format, spec.width, spec.height, spec.levels, spec.filter, spec.wrap].join(" ");
}

export function makeTexture(gl: WebGL2RenderingContext, spec: TextureSpec, data: ArrayBuffer): WebGLTexture {
  const { channels, pixels, format, type } = LAYOUTS[spec.format];
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, spec.levels, gl[spec.format], spec.width, spec.height);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  let offset = 0;
  for (let level = 0; level < spec.levels; level++) {
    const width = Math.max(1, spec.width >> level);
    const height = Math.max(1, spec.height >> level);
    const values = new pixels(data, offset, width * height * channels);
    gl.texSubImage2D(gl.TEXTURE_2D, level, 0, 0, width, height, gl[format], gl[type], values);
    offset += values.byteLength;
  }
  if (offset !== data.byteLength) {
    throw new RangeError(`Texture ${spec.url} has ${data.byteLength} bytes; expected ${offset}.`);
  }
  sampling(gl, spec.filter, spec.wrap, spec.levels);
  return texture;
}

/** Sets filter and wrap of the bound texture. */
export function sampling(gl: WebGL2RenderingContext, filter: TextureSpec["filter"], wrap: TextureSpec["wrap"], levels: number, kind: GLenum = gl.TEXTURE_2D): void {
  const min = { nearest: gl.NEAREST, linear: gl.LINEAR, linear_mipmap_linear: gl.LINEAR_MIPMAP_LINEAR }[filter];
  const mode = wrap === "repeat" ? gl.REPEAT : gl.CLAMP_TO_EDGE;
  gl.texParameteri(kind, gl.TEXTURE_MIN_FILTER, min);
  gl.texParameteri(kind, gl.TEXTURE_MAG_FILTER, filter === "nearest" ? gl.NEAREST : gl.LINEAR);
  gl.texParameteri(kind, gl.TEXTURE_WRAP_S, mode);
  gl.texParameteri(kind, gl.TEXTURE_WRAP_T, mode);
  gl.texParameteri(kind, gl.TEXTURE_MAX_LEVEL, levels - 1);
}
