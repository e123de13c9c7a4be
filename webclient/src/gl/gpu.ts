/** The WebGL2 context, its capabilities, and the resources that plans share. */
import { type Capabilities, CapabilityError, detect } from "./capabilities";
import { type CachedTarget, deleteTarget, type Mesh } from "./resources";
import { deleteProgram, type Program } from "./program";

/** A reference to a pooled resource. */
export interface Lease<V> {
  readonly value: V;
  release(): void; // Releases the reference; further calls have no effect
  discard(): void; // Removes a resource that failed to load
}

export class Pool<V> {
  private readonly entries = new Map<string, { value: V; users: number }>();

  /** `spare`: number of unused resources kept. */
  constructor(private readonly destroy: (value: V) => void, private readonly spare: number) {}

  get size(): number { return this.entries.size; }

  acquire(key: string, make: () => V): Lease<V> {
    const entry = this.entries.get(key) ?? { value: make(), users: 0 };
    // Map order is order of last use: `trim` removes from the front.
    this.entries.delete(key);
    this.entries.set(key, entry);
    entry.users += 1;
    let released = false;
    const release = () => {
      if (released) return;
      released = true;
      entry.users -= 1;
      this.trim();
    };
    const discard = () => {
      if (this.entries.get(key) === entry) {
        this.entries.delete(key);
        this.destroy(entry.value);
      }
      release();
    };
    return { value: entry.value, release, discard };
  }

  private trim(): void {
    const unused = [...this.entries].filter(([, { users }]) => users === 0);
    for (const [key, { value }] of unused.slice(0, Math.max(0, unused.length - this.spare))) {
      this.entries.delete(key);
      this.destroy(value);
    }
  }
}

const SPARE = { programs: 32, textures: 12, meshes: 4, cachedTargets: 4 }; // Numbers of unused resources that are kept

export class Gpu {
  readonly programs: Pool<Program>;
  readonly textures: Pool<Promise<WebGLTexture>>;
  readonly meshes: Pool<Mesh>;
  readonly cachedTargets: Pool<CachedTarget>; // Targets of setup passes, by a key of their contents
  readonly formats = new Set<string>(); // Formats of targets that the driver is known to draw into

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
  const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false, powerPreference: "high-performance" });
  if (gl === null) throw new CapabilityError("WebGL 2 is not available or is disabled in this browser.");
  return gl;
}

export const openGpu = (gl: WebGL2RenderingContext, hidden: ReadonlySet<string>): Gpu => new Gpu(gl, detect(gl, hidden));
