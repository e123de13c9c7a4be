/** Textures: the plan's bytes, level by level, exactly as they come. */
import type { Texture as TextureSpec } from "../generated/api";

interface Layout {
  channels: number;
  bytes: number;
  internal: "R8UI" | "R16UI" | "R16F" | "RG16F" | "R32F" | "RG32F" | "RGBA32F";
}

/** Channels and bytes a channel of each format. */
const LAYOUTS: Record<TextureSpec["format"], Layout> = {
  R8UI: { channels: 1, bytes: 1, internal: "R8UI" },
  R16UI: { channels: 1, bytes: 2, internal: "R16UI" },
  R16F: { channels: 1, bytes: 2, internal: "R16F" },
  RG16F: { channels: 2, bytes: 2, internal: "RG16F" },
  R32F: { channels: 1, bytes: 4, internal: "R32F" },
  RG32F: { channels: 2, bytes: 4, internal: "RG32F" },
  RGBA32F: { channels: 4, bytes: 4, internal: "RGBA32F" },
};

/** Same bytes, same sampling: same texture. */
export function textureKey(spec: TextureSpec): string {
  return [spec.sha256, spec.format, spec.width, spec.height, spec.levels, spec.filter, spec.wrap].join(" ");
}

export function makeTexture(gl: WebGL2RenderingContext, spec: TextureSpec, data: ArrayBuffer): WebGLTexture {
  const { channels, bytes, internal } = LAYOUTS[spec.format];
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, spec.levels, gl[internal], spec.width, spec.height);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  const whole = internal === "R8UI" || internal === "R16UI";
  const format = whole ? gl.RED_INTEGER : channels === 4 ? gl.RGBA : channels === 2 ? gl.RG : gl.RED;
  let offset = 0;
  for (let level = 0; level < spec.levels; level++) {
    const width = Math.max(1, spec.width >> level);
    const height = Math.max(1, spec.height >> level);
    const count = width * height * channels;
    const [type, pixels] =
      bytes === 4
        ? [gl.FLOAT, new Float32Array(data, offset, count)]
        : bytes === 1
          ? [gl.UNSIGNED_BYTE, new Uint8Array(data, offset, count)]
          : [whole ? gl.UNSIGNED_SHORT : gl.HALF_FLOAT, new Uint16Array(data, offset, count)];
    gl.texSubImage2D(gl.TEXTURE_2D, level, 0, 0, width, height, format, type, pixels);
    offset += count * bytes;
  }
  if (offset !== data.byteLength) {
    throw new RangeError(`${spec.url}: ${data.byteLength} bytes came where ${offset} are described`);
  }
  sampling(gl, spec.filter, spec.wrap, spec.levels);
  return texture;
}

/** Filter and wrap of the texture that is bound. */
export function sampling(
  gl: WebGL2RenderingContext,
  filter: TextureSpec["filter"],
  wrap: TextureSpec["wrap"],
  levels: number,
): void {
  const min = { nearest: gl.NEAREST, linear: gl.LINEAR, linear_mipmap_linear: gl.LINEAR_MIPMAP_LINEAR }[filter];
  const mode = wrap === "repeat" ? gl.REPEAT : gl.CLAMP_TO_EDGE;
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, min);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter === "nearest" ? gl.NEAREST : gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, mode);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, mode);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAX_LEVEL, levels - 1);
}
