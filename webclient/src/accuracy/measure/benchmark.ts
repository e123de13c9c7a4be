/** Renders every quality of a preset on this GPU in interleaved rounds: the time of each, and its error against the reference. */
import type { Api, Preset } from "../../api";
import { cameraFromScene } from "../../camera/state";
import type { Viewport } from "../../display/viewport";
import { CapabilityError } from "../../gl/capabilities";
import type { Gpu } from "../../gl/gpu";
import { clearErrors, makeScreen, readPixels, targetSize } from "../../gl/resources";
import { Executor, type Frame } from "../../plan/executor";
import { CAMERA_POINTER } from "../../plan/rules";
import { apply, diff, type Json, withValue } from "../../scene/json";
import type { Point, TruthInfo } from "../api";
import { DrawTimer } from "./drawtimer";
import { ErrorMeter, type Picture, toneCurve } from "./errors";
import { type BenchmarkResult, median, type QualityResult, type Size } from "./measured";

const MAX_ROUNDS = 5;
const MIN_ROUNDS = 3;
const LONG_RUN = 45_000; // Time after which no more than `MIN_ROUNDS` are started, ms
const MIN_TIME = { gpu: 1.5, wall: 8 }; // Least time of one measurement, ms: below it the overhead of a call dominates
const MAX_DRAWS = 16;
const MAX_PIXELS = 1280 * 720; // Largest size that is timed, pixels: multisampled targets need several times the memory
const SIZE_RATIO = 4; // Side of the large size divided by that of the small one, for the time model

export interface BenchmarkInput {
  preset: Preset;
  points: readonly Point[];
  standard: Point; // The quality that all others are compared with
  truth: Picture;
  info: TruthInfo;
}

/** The quality of a plan request for a point: its tier, or its difference from the standard quality. */
export const qualityRequest = (point: Point, standard: Point): Json => point.tier ?? apply({}, diff(standard.quality, point.quality));

/** `passTimes`: ms of each round, by pass. */
interface Entry { executor: Executor; result: QualityResult; passTimes: Map<string, number[]>; }

export class QualityBenchmark {
  private readonly entries: Entry[] = [];
  private readonly gpu: Gpu;
  private readonly meter: ErrorMeter;
  readonly result: BenchmarkResult;

  constructor(
    private readonly api: Api,
    private readonly viewport: Viewport,
    private readonly input: BenchmarkInput,
    private readonly onProgress: (share: number, step: string) => void,
    private readonly signal: AbortSignal,
  ) {
    this.gpu = viewport.gpu;
    this.meter = new ErrorMeter(input.truth, toneCurve(input.preset.scene));
    const size: Size = [input.info.width, input.info.height];
    this.result = { measured: [], unsupported: [], sizes: { large: size, small: smallSize(size) }, byGpu: false, rounds: 0 };
  }

  /** Runs until done or aborted; `result` keeps what was measured. */
  async run(): Promise<void> {
    const { points, standard } = this.input;
    const order = [standard, ...points.filter((point) => point !== standard)];
    const total = order.length * (MAX_ROUNDS + 2);
    let done = 0;
    try {
      for (const point of order) {
        this.onProgress(done / total, `Rendering ${point.label}`);
        await this.addPoint(point);
        done += 3;
      }
      this.result.rounds = 1;
      const start = performance.now();
      for (let round = 2; round <= MAX_ROUNDS; round++) {
        if (round > MIN_ROUNDS && performance.now() - start > LONG_RUN) break;
        for (let i = 0; i < this.entries.length; i++) {
          // Each round starts at another quality, so that thermal throttling affects all alike.
          const entry = this.entries[(i + round) % this.entries.length];
          if (entry === undefined) continue;
          this.onProgress(done / total, `Round ${round} of ${MAX_ROUNDS}: ${entry.result.point.label}`);
          await this.runRound(entry);
          done += 1;
        }
        this.result.rounds = round;
      }
    } finally {
      for (const { executor } of this.entries) executor.dispose();
    }
  }

  /** Loads a point, measures its error and runs its first round. */
  private async addPoint(point: Point): Promise<void> {
    const { preset, standard } = this.input;
    this.throwIfStopped();
    // The same request as the page's own, so that the server's cache has it.
    const scene = withValue(preset.scene, CAMERA_POINTER, undefined);
    const plan = await this.api.plan(scene, qualityRequest(point, standard), this.signal);
    let executor: Executor;
    try {
      executor = await Executor.load(this.gpu, plan, this.api.texture, cameraFromScene(preset.scene), false);
    } catch (error) {
      if (!(error instanceof CapabilityError)) throw error;
      this.result.unsupported.push({ point, reason: error.message });
      return;
    }
    try {
      this.throwIfStopped();
      const picture = await this.viewport.runExclusive(() => Promise.resolve(this.renderLinear(executor)));
      const result: QualityResult = { point, errors: this.meter.errors(picture), picture, rounds: [], small: [], passes: [] };
      const entry: Entry = { executor, result, passTimes: new Map() };
      if (point === standard) await this.viewport.runExclusive(() => this.chooseSize(executor));
      await this.runRound(entry);
      this.entries.push(entry);
      this.result.measured.push(result);
    } catch (error) {
      executor.dispose();
      throw error;
    }
  }

  /** Times a point once, at both sizes and by pass. */
  private async runRound({ executor, result, passTimes }: Entry): Promise<void> {
    await nextFrame();
    this.throwIfStopped();
    const { large, small } = this.result.sizes;
    await this.viewport.runExclusive(async () => {
      try {
        const largeTime = await this.withTimer(executor, large, async (timer, draw, frame) => {
          const [first = 0] = await timer.time([{ draw, count: 1 }]);
          const count = Math.min(MAX_DRAWS, Math.max(1, Math.ceil(minTime(timer) / first)));
          const [time = first] = count > 1 ? await timer.time([{ draw, count }]) : [first];
          // Passes of the same name are summed.
          const sums = new Map<string, number>();
          for (const [{ name }, passTime] of await timer.passes(executor, frame)) sums.set(name, (sums.get(name) ?? 0) + passTime);
          for (const [name, sum] of sums) passTimes.set(name, [...(passTimes.get(name) ?? []), sum]);
          return time;
        });
        const smallTime = await this.withTimer(executor, small, async (timer, draw) => {
          const [time = 0] = await timer.time([{ draw, count: 4 }]);
          return time;
        });
        this.throwIfStopped();
        result.rounds.push(largeTime);
        result.small.push(smallTime);
        result.passes = [...passTimes].map(([name, times]) => ({ name, time: median(times) }));
      } finally {
        executor.releaseTargets();
      }
    });
  }

  /** Doubles the timed size until a standard frame takes `MIN_TIME`, within the page's size and `MAX_PIXELS`. */
  private async chooseSize(executor: Executor): Promise<void> {
    const page = this.viewport.timing();
    const [maxWidth, maxHeight] = [page.width / page.scale, page.height / page.scale];
    let [width, height] = this.result.sizes.large;
    for (;;) {
      const isLong = await this.withTimer(executor, [width, height], async (timer, draw) => {
        this.result.byGpu = timer.byGpu;
        const times = [];
        for (let i = 0; i < 3; i++) times.push(...(await timer.time([{ draw, count: 1 }])));
        return Math.min(...times) >= minTime(timer);
      });
      this.throwIfStopped();
      if (isLong || 2 * width > maxWidth || 2 * height > maxHeight || 4 * width * height > MAX_PIXELS) break;
      [width, height] = [2 * width, 2 * height];
    }
    executor.releaseTargets();
    this.result.sizes = { large: [width, height], small: smallSize([width, height]) };
  }

  /** Draws once untimed, for compilation and allocation, then runs `task` with a timer. */
  private async withTimer<T>(executor: Executor, size: Size, task: (timer: DrawTimer, draw: () => void, frame: Frame) => Promise<T>): Promise<T> {
    const screen = makeScreen(this.gpu.gl, ...size);
    try {
      const frame = this.frame(size, screen.framebuffer);
      const draw = () => executor.draw(frame);
      draw();
      return await task(new DrawTimer(this.gpu, screen.framebuffer), draw, frame);
    } finally {
      screen.dispose();
    }
  }

  /** The linear frame at the reference's size, rows from the top. */
  private renderLinear(executor: Executor): Picture {
    const { gl } = this.gpu;
    const { width, height } = this.input.info;
    const { plan } = executor;
    const spec = plan.targets[plan.linear];
    if (spec === undefined) throw new Error(`The plan has no target ${plan.linear}.`);
    const [linearWidth, linearHeight] = targetSize(spec, width, height);
    if (linearWidth !== width || linearHeight !== height) {
      throw new Error(`The linear frame has ${linearWidth} × ${linearHeight} pixels, the reference ${width} × ${height}.`);
    }
    const screen = makeScreen(gl, width, height);
    try {
      clearErrors(gl);
      executor.draw(this.frame([width, height], screen.framebuffer));
      const pixels = readPixels(gl, executor.target(plan.linear)?.framebuffer ?? null, width, height, new Float32Array(width * height * 4));
      if (gl.getError() !== gl.NO_ERROR) throw new Error("The browser cannot read back floating-point pixels.");
      return { width, height, pixels };
    } finally {
      screen.dispose();
      executor.releaseTargets();
    }
  }

  private frame([width, height]: Size, screen: WebGLFramebuffer | null): Frame {
    const { preset, info } = this.input;
    return { time: info.time, camera: cameraFromScene(preset.scene), width, height, screen, scissor: null, scene: null };
  }

  private throwIfStopped(): void {
    this.signal.throwIfAborted();
    if (this.viewport.gl.isContextLost() || this.viewport.gpu !== this.gpu) {
      throw new Error("WebGL context lost. Earlier measurements are kept.");
    }
  }
}

const minTime = ({ byGpu }: DrawTimer) => (byGpu ? MIN_TIME.gpu : MIN_TIME.wall);

const smallSize = ([width, height]: Size): Size => [Math.max(1, Math.round(width / SIZE_RATIO)), Math.max(1, Math.round(height / SIZE_RATIO))];

/** Lets the page draw and handle input. */
const nextFrame = (): Promise<void> => new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve, 0)));
