/** Times draws: by GPU timer queries where available, else by the wall clock until a pixel is read back. */
import type { Pass } from "../../generated/api";
import type { Capabilities } from "../../gl/capabilities";
import type { Gpu } from "../../gl/gpu";
import type { Executor, Frame } from "../../plan/executor";

/** Attempts until a query is neither disjoint nor late, and the time after which it is late, ms. */
const QUERY_ATTEMPTS = 4;
const QUERY_TIMEOUT = 5000;

type TimerExtension = { TIME_ELAPSED_EXT: number; GPU_DISJOINT_EXT: number };

/** Null on software renderers too: their timer queries are wrong. */
export function timerExtension(gl: WebGL2RenderingContext, { extensions, software }: Capabilities): TimerExtension | null {
  const name = "EXT_disjoint_timer_query_webgl2";
  return software || !extensions.has(name) ? null : (gl.getExtension(name) as TimerExtension | null);
}

/** One thing to time: `count` runs of `draw`. */
interface TimedDraw {
  draw: () => void;
  count: number;
  /** Target of the draw, if it is not the screen. */
  target?: { framebuffer: () => WebGLFramebuffer | null; float: boolean };
}

export class DrawTimer {
  private readonly extension: TimerExtension | null;

  /** `screen`: an RGBA8 framebuffer to read back from. */
  constructor(private readonly gpu: Gpu, private readonly screen: WebGLFramebuffer | null) {
    this.extension = timerExtension(gpu.gl, gpu.capabilities);
  }

  get byGpu(): boolean { return this.extension !== null; }

  /** Milliseconds of one run of each draw. */
  async time(draws: readonly TimedDraw[]): Promise<number[]> {
    const { extension } = this;
    if (extension === null) return draws.map((draw) => this.wallTime(draw));
    for (let attempt = 0; attempt < QUERY_ATTEMPTS; attempt++) {
      const times = await this.queryTimes(extension, draws);
      if (times) return times;
    }
    throw new Error(`GPU timer queries failed ${QUERY_ATTEMPTS} times.`);
  }

  /** Milliseconds of each pass that a frame draws. */
  async passes(executor: Executor, frame: Frame): Promise<[Pass, number][]> {
    const passes: Pass[] = [];
    const draws: TimedDraw[] = [];
    executor.draw(frame, (pass, draw) => {
      const spec = executor.plan.targets[pass.target];
      const framebuffer = () => executor.target(pass.target)?.framebuffer ?? null;
      passes.push(pass);
      draws.push({ draw, count: 1, ...(spec && { target: { framebuffer, float: spec.format !== "RGBA8" } }) });
    });
    const times = await this.time(draws);
    return passes.map((pass, i) => [pass, times[i] ?? 0]);
  }

  private wallTime({ draw, count, target }: TimedDraw): number {
    this.waitFor(this.screen, false);
    const start = performance.now();
    for (let i = 0; i < count; i++) draw();
    this.waitFor(target ? target.framebuffer() : this.screen, target?.float ?? false);
    return (performance.now() - start) / count;
  }

  /** Reads a pixel of a framebuffer, which waits for the draws into it. */
  private waitFor(framebuffer: WebGLFramebuffer | null, float: boolean): void {
    const { gl } = this.gpu;
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    if (float) gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.FLOAT, new Float32Array(4));
    else gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** Null if the queries were disjoint or late. */
  private async queryTimes(extension: TimerExtension, draws: readonly TimedDraw[]): Promise<number[] | null> {
    const { gl } = this.gpu;
    // Reading the flag clears it.
    gl.getParameter(extension.GPU_DISJOINT_EXT);
    const queries = draws.map(({ draw, count }) => {
      const query = gl.createQuery();
      gl.beginQuery(extension.TIME_ELAPSED_EXT, query);
      for (let i = 0; i < count; i++) draw();
      gl.endQuery(extension.TIME_ELAPSED_EXT);
      return query;
    });
    gl.flush();
    const start = performance.now();
    try {
      // Results arrive only between tasks.
      do {
        await new Promise((resolve) => setTimeout(resolve, 2));
        if (gl.isContextLost() || performance.now() - start > QUERY_TIMEOUT) return null;
      } while (queries.some((query) => gl.getQueryParameter(query, gl.QUERY_RESULT_AVAILABLE) !== true));
      if (gl.getParameter(extension.GPU_DISJOINT_EXT) === true) return null;
      return queries.map((query, i) => (gl.getQueryParameter(query, gl.QUERY_RESULT) as number) / 1e6 / (draws[i]?.count ?? 1));
    } finally {
      for (const query of queries) gl.deleteQuery(query);
    }
  }
}
