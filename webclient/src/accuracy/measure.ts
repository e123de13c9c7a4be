/** Draws every quality of a preset on this GPU, in turn, round after round: how long each takes, how far each is off. */
import type { Api, Preset } from "../api";
import type { Stage } from "../app/stage";
import { cameraFromScene } from "../camera/state";
import { CapabilityError } from "../gl/capabilities";
import type { Gpu } from "../gl/gpu";
import { makeScreen, targetSize } from "../gl/target";
import { Executor, type Frame, type LoadBytes } from "../plan/executor";
import { CAMERA } from "../plan/live";
import { apply, diff, type Json, withValue } from "../scene/json";
import type { Point, TruthInfo } from "./api";
import { median } from "./compare";
import { type Errors, errorsOf } from "./errors";
import type { Picture } from "./npy";
import { type Lap, Stopwatch } from "./stopwatch";

/** At the most, and at the least where one takes long. */
const ROUNDS = 5;
const LEAST_ROUNDS = 3;
/** After this, ms, no more than the least rounds are begun. */
const LONG = 45_000;
/** What is timed takes at least this, ms, or what a call costs would hide it. */
const ENOUGH = { gpu: 1.5, wall: 8 };
const MOST_DRAWS = 16;
/** The largest size that is timed, pixels: many samples a pixel take many times as much memory. */
const MOST_PIXELS = 1280 * 720;
/** The second size of the time model is so many times smaller along each side. */
const SMALLER = 4;

export interface PassTime {
  name: string;
  /** ms */
  time: number;
}

export interface Measured {
  point: Point;
  errors: Errors;
  /** Linear light at the truth's size, as it was held against the truth. */
  picture: Picture;
  /** ms, one of each round. */
  rounds: number[];
  /** The same at the small size. */
  small: number[];
  passes: PassTime[];
}

export interface Sizes {
  timed: [number, number];
  small: [number, number];
}

export interface Result {
  measured: Measured[];
  /** What this GPU cannot draw, and why. */
  refused: { point: Point; why: string }[];
  sizes: Sizes;
  byGpu: boolean;
  rounds: number;
}

export interface Subject {
  preset: Preset;
  points: readonly Point[];
  /** The quality that all are held against. */
  standard: Point;
  truth: Picture;
  info: TruthInfo;
}

/** What the server is asked for a point with: the tier, or what differs from the common quality. */
export function asked(point: Point, standard: Point): Json {
  return point.tier ?? apply({}, diff(standard.quality, point.quality));
}

interface Entry {
  executor: Executor;
  measured: Measured;
  passes: Map<string, number[]>;
}

export class Measuring {
  private readonly entries: Entry[] = [];
  private readonly gpu: Gpu;
  readonly result: Result;

  constructor(
    private readonly api: Api,
    private readonly stage: Stage,
    private readonly subject: Subject,
    private readonly told: (share: number, what: string) => void,
    private readonly signal: AbortSignal,
  ) {
    this.gpu = stage.gpu;
    const { width, height } = subject.info;
    const timed: [number, number] = [width, height];
    this.result = { measured: [], refused: [], sizes: { timed, small: smaller(timed) }, byGpu: false, rounds: 0 };
  }

  /** Runs to the end, or until it is called off; what was measured until then stays in `result`. */
  async run(): Promise<void> {
    const { points, standard } = this.subject;
    const order = [standard, ...points.filter((point) => point !== standard)];
    const total = order.length * (ROUNDS + 2);
    let done = 0;
    try {
      for (const point of order) {
        this.told(done / total, `Drawing ${point.label}`);
        await this.begin(point);
        done += 3;
      }
      this.result.rounds = 1;
      const began = performance.now();
      for (let round = 2; round <= ROUNDS; round++) {
        if (round > LEAST_ROUNDS && performance.now() - began > LONG) break;
        for (let i = 0; i < this.entries.length; i++) {
          // Every round begins elsewhere, so that a machine that grows hot does so for all.
          const entry = this.entries[(i + round) % this.entries.length];
          if (entry === undefined) continue;
          this.told(done / total, `Round ${round} of ${ROUNDS}: ${entry.measured.point.label}`);
          await this.lap(entry);
          done += 1;
        }
        this.result.rounds = round;
      }
    } finally {
      for (const { executor } of this.entries) executor.dispose();
    }
  }

  /** The first round of a point: its picture, its error, its first time. */
  private async begin(point: Point): Promise<void> {
    const { preset, standard } = this.subject;
    this.check();
    // The same request as the page's own, so that the server's cache knows it.
    const scene = withValue(preset.scene, CAMERA, undefined);
    const plan = await this.api.plan(scene, asked(point, standard), this.signal);
    let executor: Executor;
    try {
      const bytes: LoadBytes = (texture) => this.api.texture(texture);
      executor = await Executor.load(this.gpu, plan, bytes, cameraFromScene(preset.scene), false);
    } catch (error) {
      if (!(error instanceof CapabilityError)) throw error;
      this.result.refused.push({ point, why: error.message });
      return;
    }
    try {
      this.check();
      const picture = await this.stage.alone(() => Promise.resolve(this.picture(executor)));
      const measured: Measured = { point, errors: errorsOf(picture, this.subject.truth), picture, rounds: [], small: [], passes: [] };
      const entry: Entry = { executor, measured, passes: new Map() };
      if (point === standard) await this.stage.alone(() => this.findSize(executor));
      await this.lap(entry);
      this.entries.push(entry);
      this.result.measured.push(measured);
    } catch (error) {
      executor.dispose();
      throw error;
    }
  }

  /** One time of a point, at both sizes and by pass. */
  private async lap({ executor, measured, passes }: Entry): Promise<void> {
    await nextFrame();
    this.check();
    const { timed, small } = this.result.sizes;
    await this.stage.alone(async () => {
      try {
        const times = await this.timed(executor, timed, async (watch, draw) => {
          const [once = 0] = await watch.time([{ draw, count: 1 }]);
          const runs = Math.min(MOST_DRAWS, Math.max(1, Math.ceil(this.enough(watch) / once)));
          const [time = once] = runs > 1 ? await watch.time([{ draw, count: runs }]) : [once];
          for (const pass of await this.byPass(executor, watch, timed)) {
            passes.set(pass.name, [...(passes.get(pass.name) ?? []), pass.time]);
          }
          return time;
        });
        const least = await this.timed(executor, small, async (watch, draw) => {
          const [time = 0] = await watch.time([{ draw, count: 4 }]);
          return time;
        });
        this.check();
        measured.rounds.push(times);
        measured.small.push(least);
        measured.passes = [...passes].map(([name, all]) => ({ name, time: median(all) }));
      } finally {
        executor.rest();
      }
    });
  }

  /** Doubles the timing size until a frame of the common quality is long enough to be told, or as large as the page. */
  private async findSize(executor: Executor): Promise<void> {
    const page = this.stage.timing();
    const [most, tall] = [page.width / page.scale, page.height / page.scale];
    let [width, height] = this.result.sizes.timed;
    for (;;) {
      const long = await this.timed(executor, [width, height], async (watch, draw) => {
        this.result.byGpu = watch.byGpu;
        const found = [];
        for (let i = 0; i < 3; i++) found.push(...(await watch.time([{ draw, count: 1 }])));
        return Math.min(...found) >= this.enough(watch);
      });
      this.check();
      if (long || 2 * width > most || 2 * height > tall || 4 * width * height > MOST_PIXELS) break;
      [width, height] = [2 * width, 2 * height];
    }
    executor.rest();
    this.result.sizes = { timed: [width, height], small: smaller([width, height]) };
  }

  private enough({ byGpu }: Stopwatch): number {
    return byGpu ? ENOUGH.gpu : ENOUGH.wall;
  }

  /** Draws once untimed, for what compiling and allocating take, then hands over what times. */
  private async timed<T>(executor: Executor, size: [number, number], work: (watch: Stopwatch, draw: () => void) => Promise<T>): Promise<T> {
    const screen = makeScreen(this.gpu.gl, ...size);
    try {
      const frame = this.frame(size, screen.framebuffer);
      const draw = () => executor.draw(frame);
      draw();
      return await work(new Stopwatch(this.gpu, screen.framebuffer), draw);
    } finally {
      screen.dispose();
    }
  }

  /** Milliseconds of each pass of one frame; passes of one name are one. */
  private async byPass(executor: Executor, watch: Stopwatch, size: [number, number]): Promise<PassTime[]> {
    const screen = makeScreen(this.gpu.gl, ...size);
    try {
      const laps: (Lap & { name: string })[] = [];
      executor.draw(this.frame(size, screen.framebuffer), ({ name, target }, draw) => {
        const spec = executor.plan.targets[target];
        const framebuffer = () => executor.target(target)?.framebuffer ?? null;
        const into = spec && { into: { framebuffer, float: spec.format !== "RGBA8" } };
        laps.push({ name, draw, count: 1, ...into });
      });
      const times = await watch.time(laps);
      const sums = new Map<string, number>();
      laps.forEach(({ name }, i) => sums.set(name, (sums.get(name) ?? 0) + (times[i] ?? 0)));
      return [...sums].map(([name, time]) => ({ name, time }));
    } finally {
      screen.dispose();
    }
  }

  /** The linear frame at the truth's size, rows from the top. */
  private picture(executor: Executor): Picture {
    const { gl } = this.gpu;
    const { width, height } = this.subject.info;
    const { plan } = executor;
    const spec = plan.targets[plan.linear];
    if (spec === undefined) throw new Error(`the plan has no target ${plan.linear}`);
    const [w, h] = targetSize(spec, width, height);
    if (w !== width || h !== height) throw new Error(`the linear frame is ${w} × ${h}, not ${width} × ${height}`);
    const screen = makeScreen(gl, width, height);
    try {
      while (gl.getError() !== gl.NO_ERROR && !gl.isContextLost());
      executor.draw(this.frame([width, height], screen.framebuffer));
      const upward = new Float32Array(width * height * 4);
      gl.bindFramebuffer(gl.FRAMEBUFFER, executor.target(plan.linear)?.framebuffer ?? null);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, upward);
      if (gl.getError() !== gl.NO_ERROR) throw new Error("This browser does not give floating-point pictures back.");
      const pixels = new Float32Array(upward.length);
      const row = 4 * width;
      for (let y = 0; y < height; y++) pixels.set(upward.subarray(y * row, (y + 1) * row), (height - 1 - y) * row);
      return { width, height, pixels };
    } finally {
      screen.dispose();
      executor.rest();
    }
  }

  private frame([width, height]: [number, number], screen: WebGLFramebuffer | null): Frame {
    const { preset, info } = this.subject;
    return { time: info.time, camera: cameraFromScene(preset.scene), width, height, screen, scissor: null, scene: null };
  }

  /** Stops here where it was called off, or where the GPU is another one now. */
  private check(): void {
    this.signal.throwIfAborted();
    if (this.stage.gl.isContextLost() || this.stage.gpu !== this.gpu) {
      throw new Error("The graphics driver took a break: what was measured until then stays.");
    }
  }
}

function smaller([width, height]: [number, number]): [number, number] {
  return [Math.max(1, Math.round(width / SMALLER)), Math.max(1, Math.round(height / SMALLER))];
}

/** Lets the page draw, and answer the visitor. */
function nextFrame(): Promise<void> {
  return new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve, 0)));
}
