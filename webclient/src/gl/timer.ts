/** GPU time of a frame, by timer queries; only for hardware, since software drivers report nonsense. */

interface TimerExtension {
  TIME_ELAPSED_EXT: number;
  GPU_DISJOINT_EXT: number;
}

export class GpuTimer {
  private readonly waiting: WebGLQuery[] = [];
  private running = false;
  /** The first query of a process may hold a wild number. */
  private primed = false;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly extension: TimerExtension,
  ) {}

  begin(): void {
    if (this.waiting.length > 3) return;
    const query = this.gl.createQuery();
    this.waiting.push(query);
    this.gl.beginQuery(this.extension.TIME_ELAPSED_EXT, query);
    this.running = true;
  }

  end(): void {
    if (this.running) this.gl.endQuery(this.extension.TIME_ELAPSED_EXT);
    this.running = false;
  }

  /** Milliseconds of the oldest finished frame, if one has finished and nothing disturbed it. */
  poll(): number | null {
    const query = this.waiting[0];
    if (query === undefined) return null;
    const { gl } = this;
    if (gl.getQueryParameter(query, gl.QUERY_RESULT_AVAILABLE) !== true) return null;
    this.waiting.shift();
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
