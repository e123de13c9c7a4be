/** What passes draw and read: textures from the plan's bytes, render targets, vertex data. */
import type { Pass, Target as TargetSpec, Texture as TextureSpec } from "../generated/api";
import type { Capabilities } from "./capabilities";

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
  if (offset !== data.byteLength) throw new RangeError(`Texture ${spec.url} has ${data.byteLength} bytes; expected ${offset}.`);
  sampling(gl, spec.filter, spec.wrap, spec.levels);
  return texture;
}

/** Sets filter and wrap of the bound texture. */
function sampling(gl: WebGL2RenderingContext, filter: TextureSpec["filter"], wrap: TextureSpec["wrap"], levels: number, kind: GLenum = gl.TEXTURE_2D): void {
  const min = { nearest: gl.NEAREST, linear: gl.LINEAR, linear_mipmap_linear: gl.LINEAR_MIPMAP_LINEAR }[filter];
  const mode = wrap === "repeat" ? gl.REPEAT : gl.CLAMP_TO_EDGE;
  gl.texParameteri(kind, gl.TEXTURE_MIN_FILTER, min);
  gl.texParameteri(kind, gl.TEXTURE_MAG_FILTER, filter === "nearest" ? gl.NEAREST : gl.LINEAR);
  gl.texParameteri(kind, gl.TEXTURE_WRAP_S, mode);
  gl.texParameteri(kind, gl.TEXTURE_WRAP_T, mode);
  gl.texParameteri(kind, gl.TEXTURE_MAX_LEVEL, levels - 1);
}

/** What targets need of a GPU. */
interface TargetGpu {
  gl: WebGL2RenderingContext;
  capabilities: Pick<Capabilities, "largestTarget">;
  formats: Set<string>; // Formats of targets that the driver is known to draw into
}

export interface Target {
  framebuffer: WebGLFramebuffer | null;
  texture: WebGLTexture | null;
  mipmapped: boolean; // Its mipmaps are generated after each pass that draws into it
  depth: WebGLRenderbuffer | null;
  width: number;
  height: number;
}

/** A target drawn once by setup passes and shared by plans. */
export interface CachedTarget extends Target { drawn: boolean; }

/** Size of a target for a picture of the given size. */
export function targetSize(spec: TargetSpec, width: number, height: number): [number, number] {
  const size = spec.size;
  if (size.rule === "fixed") return [size.width, size.height];
  const { scale, part, narrow, odd } = size;
  const sides: [number, number] = [Math.ceil((width * scale) / (part * narrow)), Math.ceil((height * scale) / part)];
  return odd ? [Math.max(3, sides[0] | 1), Math.max(3, sides[1] | 1)] : sides;
}

/** Makes a target of a format that `checkFormats` has accepted: to ask the driver here would wait for all that it draws. */
export function makeTarget({ gl, capabilities: { largestTarget } }: TargetGpu, spec: TargetSpec, width: number, height: number): Target {
  if (Math.max(width, height) > largestTarget) {
    throw new RangeError(`A target of ${width} × ${height} pixels exceeds the driver's limit of ${largestTarget}.`);
  }
  const { layers } = spec;
  const kind = layers > 1 ? gl.TEXTURE_2D_ARRAY : gl.TEXTURE_2D;
  const texture = gl.createTexture();
  gl.bindTexture(kind, texture);
  const mipmapped = spec.filter === "linear_mipmap_linear";
  const levels = mipmapped ? 1 + Math.floor(Math.log2(Math.max(width, height))) : 1;
  if (layers > 1) gl.texStorage3D(kind, levels, gl[spec.format], width, height, layers);
  else gl.texStorage2D(kind, levels, gl[spec.format], width, height);
  sampling(gl, spec.filter, spec.wrap, levels, kind);
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  if (layers > 1) {
    const attachments = Array.from({ length: layers }, (_, layer) => gl.COLOR_ATTACHMENT0 + layer);
    attachments.forEach((attachment, layer) => gl.framebufferTextureLayer(gl.FRAMEBUFFER, attachment, texture, 0, layer));
    gl.drawBuffers(attachments);
  } else {
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, kind, texture, 0);
  }
  const depth = spec.depth ? gl.createRenderbuffer() : null;
  if (depth !== null) {
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
  }
  return { framebuffer, texture, mipmapped, depth, width, height };
}

/** Throws for a format that the driver cannot draw into; each is tried once. */
export function checkFormats(gpu: TargetGpu, specs: readonly TargetSpec[]): void {
  const { gl, formats } = gpu;
  for (const spec of specs) {
    const format = `${spec.format} target${spec.depth ? " with depth" : ""}${spec.layers > 1 ? ` of ${spec.layers} layers` : ""}`;
    if (formats.has(format)) continue;
    const target = makeTarget(gpu, spec, 1, 1);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    const status = gl.checkFramebufferStatus(gl.FRAMEBUFFER);
    if (status !== gl.FRAMEBUFFER_COMPLETE && !gl.isContextLost()) throw new Error(`Framebuffer incomplete (0x${status.toString(16)}): ${format}.`);
    deleteTarget(gl, target);
    formats.add(format);
  }
}

/** A picture that is not shown. */
export interface Screen extends Target { dispose(): void; }

/** An offscreen RGBA8 framebuffer, which every driver can draw into, in place of the canvas. */
export function makeScreen(gl: WebGL2RenderingContext, width: number, height: number): Screen {
  const colour = gl.createRenderbuffer();
  gl.bindRenderbuffer(gl.RENDERBUFFER, colour);
  gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, width, height);
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, colour);
  const target = { framebuffer, texture: null, mipmapped: false, depth: null, width, height };
  const dispose = () => {
    deleteTarget(gl, target);
    gl.deleteRenderbuffer(colour);
  };
  return { ...target, dispose };
}

export function deleteTarget(gl: WebGL2RenderingContext, target: Target): void {
  gl.deleteFramebuffer(target.framebuffer);
  gl.deleteTexture(target.texture);
  gl.deleteRenderbuffer(target.depth);
}

/** Pixels of a framebuffer, rows from the top. */
export function readPixels<T extends Uint8Array | Float32Array>(gl: WebGL2RenderingContext, framebuffer: WebGLFramebuffer | null, width: number, height: number, pixels: T): T {
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.readPixels(0, 0, width, height, gl.RGBA, pixels instanceof Float32Array ? gl.FLOAT : gl.UNSIGNED_BYTE, pixels);
  const row = 4 * width;
  for (let y = 0; 2 * y < height - 1; y++) {
    const [top, foot] = [y * row, (height - 1 - y) * row];
    const held = pixels.slice(top, top + row);
    pixels.copyWithin(top, foot, foot + row);
    pixels.set(held, foot);
  }
  return pixels;
}

/** Forgets earlier errors of the context. */
export function clearErrors(gl: WebGL2RenderingContext): void {
  while (gl.getError() !== gl.NO_ERROR && !gl.isContextLost());
}

type MeshSpec = Pass["mesh"];

export interface Mesh { draw(): void; dispose(): void; }

export function meshKey(spec: MeshSpec): string {
  if (spec.rule === "grid") return `grid ${spec.rows} ${spec.columns}`;
  return spec.rule === "fullscreen" ? spec.rule : `${spec.rule} ${spec.count}`;
}

/** Vertices (column/columns, row/rows), columns first, and two triangles a cell. */
export function gridData(rows: number, columns: number): { vertices: Float32Array; indices: Uint32Array } {
  const across = columns + 1;
  const vertices = new Float32Array((rows + 1) * across * 2);
  for (let i = 0; i < vertices.length / 2; i++) vertices.set([(i % across) / columns, Math.floor(i / across) / rows], 2 * i);
  const indices = new Uint32Array(rows * columns * 6);
  for (let cell = 0; cell < rows * columns; cell++) {
    const first = Math.floor(cell / columns) * across + (cell % columns);
    const next = first + across;
    indices.set([first, first + 1, next, next, first + 1, next + 1], 6 * cell);
  }
  return { vertices, indices };
}

export function makeMesh(gl: WebGL2RenderingContext, spec: MeshSpec): Mesh {
  const array = gl.createVertexArray();
  if (spec.rule !== "grid") {
    const mode = spec.rule === "points" ? gl.POINTS : gl.TRIANGLES;
    const count = spec.rule === "points" ? spec.count : spec.rule === "quads" ? 6 * spec.count : 3;
    const draw = () => {
      gl.bindVertexArray(array);
      gl.drawArrays(mode, 0, count);
    };
    return { draw, dispose: () => gl.deleteVertexArray(array) };
  }
  const { vertices, indices } = gridData(spec.rows, spec.columns);
  const vertexBuffer = gl.createBuffer();
  const indexBuffer = gl.createBuffer();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, vertexBuffer);
  gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indexBuffer);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
  gl.bindVertexArray(null);
  const draw = () => {
    gl.bindVertexArray(array);
    gl.drawElements(gl.TRIANGLES, indices.length, gl.UNSIGNED_INT, 0);
  };
  const dispose = () => {
    gl.deleteVertexArray(array);
    gl.deleteBuffer(vertexBuffer);
    gl.deleteBuffer(indexBuffer);
  };
  return { draw, dispose };
}
