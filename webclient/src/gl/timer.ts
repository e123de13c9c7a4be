/** GPU time of a frame, by timer queries. */
import type { Capabilities } from "./capabilities";

export interface TimerExtension {
  TIME_ELAPSED_EXT: number;
  GPU_DISJOINT_EXT: number;
}

/** Null on software renderers too: their timer queries are wrong. */
export function timerExtension(gl: WebGL2RenderingContext, { extensions, software }: Capabilities): TimerExtension | null {
  const name = "EXT_disjoint_timer_query_webgl2";
  return software || !extensions.has(name) ? null : (gl.getExtension(name) as TimerExtension | null);
}

export class GpuTimer {
  private readonly queries: WebGLQuery[] = [];
  private running = false;
  /** The first query of a process may return a wrong number. */
  private primed = false;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly extension: TimerExtension,
  ) {}

  begin(): void {
    if (this.queries.length > 3) return;
    const query = this.gl.createQuery();
    this.queries.push(query);
    this.gl.beginQuery(this.extension.TIME_ELAPSED_EXT, query);
    this.running = true;
  }

  end(): void {
    if (this.running) this.gl.endQuery(this.extension.TIME_ELAPSED_EXT);
    this.running = false;
  }

  /** Milliseconds of the oldest finished frame; null if none has finished or the query was disjoint. */
  poll(): number | null {
    const query = this.queries[0];
    if (query === undefined) return null;
    const { gl } = this;
    if (gl.getQueryParameter(query, gl.QUERY_RESULT_AVAILABLE) !== true) return null;
    this.queries.shift();
    const disjoint = gl.getParameter(this.extension.GPU_DISJOINT_EXT) === true;
    const nanoseconds = gl.getQueryParameter(query, gl.QUERY_RESULT) as number;
    gl.deleteQuery(query);
    if (disjoint || !this.primed) {
      this.primed = true;
      return null;
    }
    return nanoseconds / 1e6;
  }
}
