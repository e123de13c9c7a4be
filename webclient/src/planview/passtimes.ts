/** GPU time of each pass of a frame, by timer queries. */
import { DrawTimer, timerExtension } from "../accuracy/measure/drawtimer";
import { median } from "../accuracy/measure/statistics";
import type { Pass } from "../generated/api";
import { makeScreen } from "../gl/target";
import type { Gpu } from "../gl/gpu";
import type { Executor, Frame } from "../plan/executor";

/** Frames that are measured; the median of each pass counts. The first ones compile and allocate. */
const FRAMES = 7;
const WARM_UP = 2;

/** Why there are no times; null if there can be. */
export function reasonForNoTimes(gpu: Gpu | null): string | null {
  if (gpu === null) return "Not measured: the server draws the frames.";
  if (gpu.capabilities.software) return `Not measured: ${gpu.capabilities.renderer} draws on the CPU, where timer queries are wrong.`;
  if (timerExtension(gpu.gl, gpu.capabilities)) return null;
  return "Not measured: this browser gives no access to GPU timers (EXT_disjoint_timer_query_webgl2).";
}

/** Milliseconds by pass; throws if the queries fail. Passes that this camera does not need have none. */
export async function passTimes(gpu: Gpu, executor: Executor, view: Pick<Frame, "time" | "camera" | "width" | "height">): Promise<Map<Pass, number>> {
  const samples = new Map<Pass, number[]>();
  const screen = makeScreen(gpu.gl, view.width, view.height);
  try {
    const timer = new DrawTimer(gpu, screen.framebuffer);
    const frame = { ...view, screen: screen.framebuffer, scissor: null, scene: null };
    for (let number = 0; number < FRAMES; number++) {
      const times = await timer.passes(executor, frame);
      if (number < WARM_UP) continue;
      for (const [pass, time] of times) samples.set(pass, [...(samples.get(pass) ?? []), time]);
    }
  } finally {
    screen.dispose();
  }
  return new Map([...samples].map(([pass, times]) => [pass, median(times)]));
}
