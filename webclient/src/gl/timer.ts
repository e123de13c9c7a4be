/** Timer queries of the GPU. */
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
