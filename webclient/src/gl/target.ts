/** Render targets. */
import type { Target as TargetSpec } from "../generated/api";
import { sampling } from "./texture";

export interface Target {
  framebuffer: WebGLFramebuffer | null;
  texture: WebGLTexture | null;
  /** Its mipmaps are generated after each pass that draws into it. */
  mipmapped: boolean;
  depth: WebGLRenderbuffer | null;
  width: number;
  height: number;
}

/** A target drawn once by setup passes and shared by plans. */
export interface CachedTarget extends Target {
  drawn: boolean;
}

/** Size of a target for a picture of the given size. */
export function targetSize(spec: TargetSpec, width: number, height: number): [number, number] {
  const size = spec.size;
  if (size.rule === "fixed") return [size.width, size.height];
  const { scale, part, narrow } = size;
  return [Math.ceil((width * scale) / (part * narrow)), Math.ceil((height * scale) / part)];
}

export function makeTarget(gl: WebGL2RenderingContext, spec: TargetSpec, width: number, height: number): Target {
  const limit = Math.min(gl.getParameter(gl.MAX_TEXTURE_SIZE) as number, gl.getParameter(gl.MAX_RENDERBUFFER_SIZE) as number);
  if (width > limit || height > limit) {
    throw new RangeError(`A target of ${width} × ${height} pixels exceeds the driver's limit of ${limit}.`);
  }
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  const mipmapped = spec.filter === "linear_mipmap_linear";
  const levels = mipmapped ? 1 + Math.floor(Math.log2(Math.max(width, height))) : 1;
  gl.texStorage2D(gl.TEXTURE_2D, levels, gl[spec.format], width, height);
  sampling(gl, spec.filter, spec.wrap, levels);
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  const depth = spec.depth ? depthBuffer(gl, width, height) : null;
  checkComplete(gl, `${spec.format} target of ${width} × ${height}`);
  return { framebuffer, texture, mipmapped, depth, width, height };
}

/** An offscreen RGBA8 framebuffer in place of the canvas. */
export function makeScreen(gl: WebGL2RenderingContext, width: number, height: number): Target & { dispose(): void } {
  const colour = gl.createRenderbuffer();
  gl.bindRenderbuffer(gl.RENDERBUFFER, colour);
  gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, width, height);
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, colour);
  checkComplete(gl, `screen of ${width} × ${height}`);
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

function depthBuffer(gl: WebGL2RenderingContext, width: number, height: number): WebGLRenderbuffer {
  const depth = gl.createRenderbuffer();
  gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
  gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
  gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
  return depth;
}

function checkComplete(gl: WebGL2RenderingContext, what: string): void {
  const status = gl.checkFramebufferStatus(gl.FRAMEBUFFER);
  if (status !== gl.FRAMEBUFFER_COMPLETE && !gl.isContextLost()) {
    throw new Error(`Framebuffer incomplete (0x${status.toString(16)}): ${what}.`);
  }
}
