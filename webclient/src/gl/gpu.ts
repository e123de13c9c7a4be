/** The WebGL2 context, what it can do, and the resources that plans share on it. */
import { type Capabilities, CapabilityError, detect } from "./capabilities";
import type { Mesh } from "./mesh";
import { Pool } from "./pool";
import { deleteProgram, type Program } from "./program";
import { deleteTarget, type CachedTarget } from "./target";

/** Unused resources that stay on the GPU. */
const SPARE = { programs: 32, textures: 12, meshes: 4, cachedTargets: 4 };

export class Gpu {
  readonly programs: Pool<Program>;
  readonly textures: Pool<Promise<WebGLTexture>>;
  readonly meshes: Pool<Mesh>;
  /** What setup passes leave in their targets, by what it hangs on. */
  readonly cachedTargets: Pool<CachedTarget>;

  /** After a lost context is restored, a new one is made on the same `gl`: nothing of the old survives. */
  constructor(
    readonly gl: WebGL2RenderingContext,
    readonly capabilities: Capabilities,
  ) {
    this.programs = new Pool((program) => deleteProgram(gl, program), SPARE.programs);
    const deleteTexture = (texture: Promise<WebGLTexture>) =>
      void texture.then(
        (texture) => gl.deleteTexture(texture),
        () => undefined,
      );
    this.textures = new Pool(deleteTexture, SPARE.textures);
    this.meshes = new Pool((mesh) => mesh.dispose(), SPARE.meshes);
    this.cachedTargets = new Pool((target) => deleteTarget(gl, target), SPARE.cachedTargets);
  }
}

/** The context of a canvas; throws a `CapabilityError` fit for the visitor where there is none. */
export function openContext(canvas: HTMLCanvasElement): WebGL2RenderingContext {
  const gl = canvas.getContext("webgl2", {
    alpha: false,
    antialias: false,
    depth: false,
    powerPreference: "high-performance",
  });
  if (gl === null) {
    throw new CapabilityError("This browser offers no WebGL 2, or has it switched off.");
  }
  return gl;
}

export function openGpu(gl: WebGL2RenderingContext, hidden: ReadonlySet<string>): Gpu {
  return new Gpu(gl, detect(gl, hidden));
}
