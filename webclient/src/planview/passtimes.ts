/** GPU time of each pass of a frame, by timer queries. */
import type { CameraState } from "../camera/state";
import type { Pass } from "../generated/api";
import { makeScreen } from "../gl/target";
import type { Gpu } from "../gl/gpu";
import { timerExtension } from "../gl/timer";
import type { Executor } from "../plan/executor";

/** Frames that are measured; the median of each pass counts. The first ones compile and allocate. */
const FRAMES = 7;
const WARM_UP = 2;
/** Time after which a query is given up, ms. */
const TIMEOUT = 4000;

interface TimedView {
  time: number;
  camera: CameraState;
  width: number;
  height: number;
}

/** Why there are no times; null if there can be. */
export function reasonForNoTimes(gpu: Gpu | null): string | null {
  if (gpu === null) return "Not measured: the server draws the frames.";
  if (gpu.capabilities.software) return `Not measured: ${gpu.capabilities.renderer} draws on the CPU, where timer queries are wrong.`;
  if (timerExtension(gpu.gl, gpu.capabilities)) return null;
  return "Not measured: this browser gives no access to GPU timers (EXT_disjoint_timer_query_webgl2).";
}

/** Milliseconds by pass; throws if the queries fail. Passes that this camera does not need have none. */
export async function passTimes(gpu: Gpu, executor: Executor, view: TimedView): Promise<Map<Pass, number>> {
  const samples = new Map<Pass, number[]>();
  for (let frame = 0; frame < FRAMES; frame++) {
    const times = await frameTimes(gpu, executor, view);
    if (frame < WARM_UP) continue;
    for (const [pass, time] of times) samples.set(pass, [...(samples.get(pass) ?? []), time]);
  }
  return new Map([...samples].map(([pass, times]) => [pass, median(times)]));
}

async function frameTimes(gpu: Gpu, executor: Executor, { time, camera, width, height }: TimedView): Promise<Map<Pass, number>> {
  const { gl } = gpu;
  const extension = timerExtension(gl, gpu.capabilities);
  if (extension === null) throw new Error("GPU timers are not available.");
  const queries: [Pass, WebGLQuery][] = [];
  const screen = makeScreen(gl, width, height);
  try {
    gl.getParameter(extension.GPU_DISJOINT_EXT);
    executor.draw({ time, camera, width, height, screen: screen.framebuffer, scissor: null, scene: null }, (pass, draw) => {
      const query = gl.createQuery();
      gl.beginQuery(extension.TIME_ELAPSED_EXT, query);
      draw();
      gl.endQuery(extension.TIME_ELAPSED_EXT);
      queries.push([pass, query]);
    });
    gl.flush();
    const start = performance.now();
    while (queries.some(([, query]) => gl.getQueryParameter(query, gl.QUERY_RESULT_AVAILABLE) !== true)) {
      if (gl.isContextLost() || performance.now() - start > TIMEOUT) throw new Error("GPU timer queries gave no result.");
      await new Promise((resolve) => setTimeout(resolve, 2));
    }
    if (gl.getParameter(extension.GPU_DISJOINT_EXT) === true) throw new Error("The GPU's clock changed during the measurement. Measure again.");
    return new Map(queries.map(([pass, query]) => [pass, (gl.getQueryParameter(query, gl.QUERY_RESULT) as number) / 1e6]));
  } finally {
    for (const [, query] of queries) gl.deleteQuery(query);
    screen.dispose();
  }
}

function median(values: readonly number[]): number {
  const sorted = values.toSorted((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)] ?? 0;
}
