/** How long drawing takes: by the GPU's own clock where that can be believed, else until a pixel has come back. */
import type { Gpu } from "../gl/gpu";

interface TimerExtension {
  TIME_ELAPSED_EXT: number;
  GPU_DISJOINT_EXT: number;
}

/** Tries until a query is neither late nor disturbed. */
const TRIES = 4;
const LATE = 5000;

/** One thing to time: `count` runs of `draw`. */
export interface Lap {
  draw: () => void;
  count: number;
  /** What is drawn into, where it is not the screen. */
  into?: { framebuffer: () => WebGLFramebuffer | null; float: boolean };
}

export class Stopwatch {
  private readonly extension: TimerExtension | null;

  /** `screen`: a finished RGBA8 framebuffer to wait on. */
  constructor(
    private readonly gpu: Gpu,
    private readonly screen: WebGLFramebuffer | null,
  ) {
    const { extensions, software } = gpu.capabilities;
    const name = "EXT_disjoint_timer_query_webgl2";
    this.extension = software || !extensions.has(name) ? null : (gpu.gl.getExtension(name) as TimerExtension | null);
  }

  get byGpu(): boolean {
    return this.extension !== null;
  }

  /** Milliseconds of one run of each lap. */
  async time(laps: readonly Lap[]): Promise<number[]> {
    const { extension } = this;
    if (extension === null) return laps.map((lap) => this.wall(lap));
    for (let attempt = 0; attempt < TRIES; attempt++) {
      const found = await this.queried(extension, laps);
      if (found) return found;
    }
    throw new Error("The graphics driver gives no times: its clock was disturbed again and again.");
  }

  private wall({ draw, count, into }: Lap): number {
    this.finish(this.screen, false);
    const start = performance.now();
    for (let i = 0; i < count; i++) draw();
    this.finish(into ? into.framebuffer() : this.screen, into?.float ?? false);
    return (performance.now() - start) / count;
  }

  /** Waits for what is drawn into a framebuffer: its pixels can be read only then. Others may be put off for longer. */
  private finish(framebuffer: WebGLFramebuffer | null, float: boolean): void {
    const { gl } = this.gpu;
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    if (float) gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.FLOAT, new Float32Array(4));
    else gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  private async queried(extension: TimerExtension, laps: readonly Lap[]): Promise<number[] | null> {
    const { gl } = this.gpu;
    // Reading the flag clears it: what was disturbed before is no concern.
    gl.getParameter(extension.GPU_DISJOINT_EXT);
    const queries = laps.map(({ draw, count }) => {
      const query = gl.createQuery();
      gl.beginQuery(extension.TIME_ELAPSED_EXT, query);
      for (let i = 0; i < count; i++) draw();
      gl.endQuery(extension.TIME_ELAPSED_EXT);
      return query;
    });
    gl.flush();
    const began = performance.now();
    try {
      // Results only come while the page's own code rests.
      do {
        await new Promise((resolve) => setTimeout(resolve, 2));
        if (gl.isContextLost() || performance.now() - began > LATE) return null;
      } while (queries.some((query) => gl.getQueryParameter(query, gl.QUERY_RESULT_AVAILABLE) !== true));
      if (gl.getParameter(extension.GPU_DISJOINT_EXT) === true) return null;
      return queries.map((query, i) => (gl.getQueryParameter(query, gl.QUERY_RESULT) as number) / 1e6 / (laps[i]?.count ?? 1));
    } finally {
      for (const query of queries) gl.deleteQuery(query);
    }
  }
}
