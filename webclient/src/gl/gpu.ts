/** The WebGL2 context, its capabilities, and the resources that plans share. */
import { type Capabilities, CapabilityError, detect } from "./capabilities";
import type { Mesh } from "./mesh";
import { Pool } from "./pool";
import { deleteProgram, type Program } from "./program";
import { deleteTarget, type CachedTarget } from "./target";

/** Numbers of unused resources that are kept. */
const SPARE = { programs: 32, textures: 12, meshes: 4, cachedTargets: 4 };

export class Gpu {
  readonly programs: Pool<Program>;
  readonly textures: Pool<Promise<WebGLTexture>>;
  readonly meshes: Pool<Mesh>;
  /** Targets of setup passes, by a key of their contents. */
  readonly cachedTargets: Pool<CachedTarget>;
  /** Formats of targets that the driver is known to draw into. */
  readonly formats = new Set<string>();

  /** After a lost context a new instance is made on the same `gl`. */
  constructor(readonly gl: WebGL2RenderingContext, readonly capabilities: Capabilities) {
    this.programs = new Pool((program) => deleteProgram(gl, program), SPARE.programs);
    const deleteTexture = (texture: Promise<WebGLTexture>) =>
      void texture.then((texture) => gl.deleteTexture(texture), () => undefined);
    this.textures = new Pool(deleteTexture, SPARE.textures);
    this.meshes = new Pool((mesh) => mesh.dispose(), SPARE.meshes);
    this.cachedTargets = new Pool((target) => deleteTarget(gl, target), SPARE.cachedTargets);
  }
}

/** Throws a `CapabilityError` without WebGL 2. */
export function openContext(canvas: HTMLCanvasElement): WebGL2RenderingContext {
  const gl = canvas.getContext("webgl2", {
    alpha: false,
    antialias: false,
    depth: false,
    powerPreference: "high-performance",
  });
  if (gl === null) {
    throw new CapabilityError("WebGL 2 is not available or is disabled in this browser.");
  }
  return gl;
}

export function openGpu(gl: WebGL2RenderingContext, hidden: ReadonlySet<string>): Gpu {
  return new Gpu(gl, detect(gl, hidden));
}
