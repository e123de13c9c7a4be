/** The canvas: owns the GPU, draws one picture or two side by side, and measures frame times. */
import { type Gpu, openContext, openGpu } from "../gl/gpu";
import { GpuTimer, timerExtension } from "../gl/timer";
import type { Frame, Rectangle } from "../plan/executor";
import type { RenderLoad } from "./autoquality";
import { type Display, type DisplayEvents, type FrameTiming, pixelRatio, type ViewState } from "./display";
import type { PlanLoader } from "./planloader";
import { CPU_BUDGET, DynamicResolution, type FrameBudget, gpuBudget } from "./resolution";

/** First scale on a CPU: a frame that takes seconds would lose the context. */
const SOFTWARE_SCALE = 0.5;
/** The display's interval until it is measured, ms, and the animation frames that one measurement takes. */
const DISPLAY_INTERVAL = 1000 / 60;
const DISPLAY_FRAMES = 40;
/** Time between two checks of a fence, ms; browsers raise it to 4 after a few. */
const POLL_INTERVAL = 1;
/** Share of a frame's usual time before its fence is first checked. */
const UNPOLLED_SHARE = 0.6;
/** The measured load is valid after this many windows at one scale, or this many in all where the scale never settles. */
const STABLE_WINDOWS = 2;
const MAX_WINDOWS = 5;
/** Frames drawn at rest to measure the frame time, and how many of them at first are not measured. */
const TRIAL_FRAMES = 6;
const COLD_FRAMES = 2;
/** At rest the scale is raised in steps, unless the next frame would take longer than this, ms. */
const MAX_SHARPENING_TIME = 3000;
const SHARPENING_STEP = 2;
const SHARPENING_DELAY = 500;

interface PendingFrame {
  /** Fence before the frame's first command: time until it signals belongs to other work. */
  before: WebGLSync | null;
  after: WebGLSync;
  start: number;
  scale: number;
  /** Drawn to sharpen a still picture: its time is not part of the load in motion. */
  sharpening: boolean;
}

export class Viewport implements Display {
  readonly viewport = this;
  readonly gl: WebGL2RenderingContext;
  gpu: Gpu;
  /** Whether the canvas is out of date. */
  dirty = true;
  private timer: GpuTimer | null = null;
  private readonly resolution = new DynamicResolution();
  private readonly pending: PendingFrame[] = [];
  /** When the frames of the last second were done. */
  private readonly recent: number[] = [];
  private frameTime: number | null = null;
  private lastDraw = 0;
  /** When the latest frame in motion was done; null after a pause. */
  private lastDone: number | null = null;
  private polling = false;
  private frames = 0;
  private fixedScale: number | null = null;
  private displayInterval = DISPLAY_INTERVAL;
  /** Shortest interval between animation frames in the current measurement. */
  private shortest = { interval: Infinity, frames: 0 };
  private lastTick = 0;
  private scale = 1;
  private finished: { scale: number; milliseconds: number } | null = null;
  /** Frames drawn since the last reset. */
  private trials = 0;
  /** How many tasks have exclusive use of the GPU. */
  private exclusiveTasks = 0;

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly loaders: readonly [PlanLoader, PlanLoader],
    private readonly hidden: ReadonlySet<string>,
    private readonly events: DisplayEvents,
  ) {
    this.gl = openContext(canvas);
    this.gpu = openGpu(this.gl, hidden);
    this.timer = this.makeTimer();
    canvas.addEventListener("webglcontextlost", (event) => {
      // Without this the browser does not restore the context.
      event.preventDefault();
      this.pending.length = 0;
      this.events.contextLost();
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.gpu = openGpu(this.gl, this.hidden);
      this.timer = this.makeTimer();
      this.dirty = true;
      this.events.contextRestored();
    });
    new ResizeObserver(() => (this.dirty = true)).observe(canvas);
  }

  get blank(): boolean {
    return this.loaders[0].loaded === null;
  }

  /** Whether the canvas is up to date at its final scale and the GPU is idle. */
  get atRest(): boolean {
    return !this.dirty && this.pending.length === 0 && !this.unmeasured && this.sharperScale() === null;
  }

  get fixed(): number | null {
    return this.fixedScale;
  }

  setFixedScale(scale: number | null): void {
    if (scale === this.fixedScale) return;
    this.fixedScale = scale;
    this.resetMeasurement();
  }

  tick(now: number, view: ViewState, moving: boolean): void {
    if (this.gl.isContextLost()) return;
    this.measureDisplay(now);
    this.collect();
    if (this.exclusiveTasks > 0) return;
    const sharpening = !moving && !this.dirty && !this.unmeasured;
    if (!moving) this.lastDone = null;
    const { software } = this.gpu.capabilities;
    // On a CPU a second pending frame gains nothing, and compositing between the two could not be told from drawing.
    if (this.loaders[0].loaded === null || this.pending.length > (software ? 0 : 1)) return;
    const scale = sharpening ? this.sharperScale() : (this.fixedScale ?? this.resolution.scale);
    if (scale === null || (sharpening && now - this.lastDraw < SHARPENING_DELAY)) return;
    this.dirty = false;
    this.lastDraw = now;
    this.trials += 1;
    this.scale = scale;
    this.resizeCanvas(scale);
    const before = software ? this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0) : null;
    this.timer?.begin();
    this.draw(view);
    this.timer?.end();
    const after = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
    if (after) this.pending.push({ before, after, start: performance.now(), scale, sharpening });
    this.poll();
  }

  /** Checks the fences between animation frames, which may come long after the GPU is done. */
  private poll(delay = POLL_INTERVAL): void {
    if (this.polling) return;
    this.polling = true;
    setTimeout(() => {
      this.polling = false;
      if (this.gl.isContextLost()) return;
      const hadStarted = this.pending[0]?.before === null;
      this.collect();
      const [frame] = this.pending;
      if (frame === undefined) return;
      const justStarted = !hadStarted && frame.before === null;
      this.poll(justStarted ? UNPOLLED_SHARE * (this.frameTime ?? 0) : POLL_INTERVAL);
    }, delay);
  }

  private measureDisplay(now: number): void {
    const { shortest } = this;
    if (this.lastTick > 0 && now > this.lastTick) shortest.interval = Math.min(shortest.interval, now - this.lastTick);
    this.lastTick = now;
    shortest.frames += 1;
    if (shortest.frames < DISPLAY_FRAMES) return;
    this.displayInterval = Math.min(2 * DISPLAY_INTERVAL, Math.max(DISPLAY_INTERVAL / 4, shortest.interval));
    this.shortest = { interval: Infinity, frames: 0 };
  }

  /** Draws at scale 1 and returns a PNG. */
  async png(view: ViewState): Promise<Blob> {
    this.resizeCanvas(1);
    this.draw(view);
    this.dirty = true;
    // The drawing buffer is valid only until the next task: no await before this.
    return new Promise((resolve, reject) =>
      this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("PNG encoding failed."))), "image/png"),
    );
  }

  /** Runs a task while no frame of the page is drawn or pending. */
  async runExclusive<T>(task: () => Promise<T>): Promise<T> {
    this.exclusiveTasks += 1;
    try {
      while (this.pending.length > 0) await new Promise((resolve) => setTimeout(resolve, 4));
      return await task();
    } finally {
      this.exclusiveTasks -= 1;
    }
  }

  timing(): FrameTiming {
    const now = performance.now();
    while (this.recent[0] !== undefined && now - this.recent[0] > 1000) this.recent.shift();
    const { canvas: { width, height }, scale, frames, frameTime: frame } = this;
    return { frame, clock: this.timer === null ? "fence" : "gpu", fps: this.recent.length, width, height, scale, frames };
  }

  /** The load in motion; null until it is measured, and while the scale is fixed. */
  load(): RenderLoad | null {
    const settled = this.resolution.stableWindows >= STABLE_WINDOWS || this.resolution.windows >= MAX_WINDOWS;
    if (this.fixedScale !== null || this.frameTime === null || !settled) return null;
    const { clientWidth, clientHeight } = this.canvas;
    return {
      budget: this.budget,
      scale: this.resolution.scale,
      renderTime: this.frameTime,
      overhead: this.gpu.capabilities.software ? this.resolution.overhead : 0,
      megapixels: 1e-6 * clientWidth * clientHeight * pixelRatio() ** 2,
    };
  }

  resetMeasurement(expectedScale: number | null = null): void {
    const samples = Math.max(...this.loaders.map((loader) => loader.plan?.samples ?? 1));
    this.resolution.reset(expectedScale ?? (this.gpu.capabilities.software ? SOFTWARE_SCALE / Math.sqrt(samples) : 1));
    this.frameTime = null;
    this.lastDone = null;
    this.trials = 0;
    this.dirty = true;
  }

  private draw({ time, camera, divider }: ViewState): void {
    const { width, height } = this.canvas;
    const [left, right] = this.loaders;
    const frame: Frame = { time, camera, width, height, screen: null, scissor: null, scene: null };
    try {
      if (right.loaded === null) {
        left.loaded?.executor?.draw({ ...frame, scene: left.loaded.scene });
        return;
      }
      const x = Math.round(width * divider);
      const parts: [PlanLoader, Rectangle][] = [
        [left, { x: 0, y: 0, width: x, height }],
        [right, { x, y: 0, width: width - x, height }],
      ];
      for (const [{ loaded }, scissor] of parts) {
        if (loaded && scissor.width > 0) loaded.executor?.draw({ ...frame, scissor, scene: loaded.scene });
      }
    } catch (error) {
      this.loaders.forEach((loader) => loader.clear());
      this.events.failed(error);
    }
  }

  private get unmeasured(): boolean {
    return this.frameTime === null && this.trials < TRIAL_FRAMES;
  }

  /** The next scale to sharpen a still picture with; null if the current one is final. */
  private sharperScale(): number | null {
    const { finished } = this;
    if (this.fixedScale !== null || finished === null || finished.scale !== this.scale || this.scale >= 1) return null;
    const next = Math.min(1, this.scale * SHARPENING_STEP);
    return finished.milliseconds * (next / this.scale) ** 2 > MAX_SHARPENING_TIME ? null : next;
  }

  private get budget(): FrameBudget {
    return this.gpu.capabilities.software ? CPU_BUDGET : gpuBudget(this.displayInterval);
  }

  private resizeCanvas(scale: number): void {
    const ratio = pixelRatio() * scale;
    const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    // Setting a canvas's size clears it, even to the same size.
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
  }

  /** Removes pending frames that the GPU has finished and records their times. */
  private collect(): void {
    const { gl } = this;
    const isSignalled = (fence: WebGLSync) => gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED;
    for (let frame = this.pending[0]; frame !== undefined; frame = this.pending[0]) {
      if (frame.before !== null && isSignalled(frame.before)) {
        gl.deleteSync(frame.before);
        frame.before = null;
        frame.start = performance.now();
      }
      if (!isSignalled(frame.after)) break;
      gl.deleteSync(frame.after);
      this.pending.shift();
      this.recordFrame(frame, performance.now());
      this.events.frameDone();
    }
    const milliseconds = this.timer?.poll();
    if (typeof milliseconds === "number") this.recordTime(milliseconds);
  }

  private recordFrame({ start, scale, sharpening }: PendingFrame, now: number): void {
    const { software } = this.gpu.capabilities;
    const elapsed = now - start;
    this.frames += 1;
    this.recent.push(now);
    this.finished = { scale, milliseconds: elapsed };
    const previousDone = this.lastDone;
    this.lastDone = sharpening ? null : now;
    if (sharpening) return;
    if (previousDone === null) {
      // The first frame after a pause has no interval.
      this.resolution.restartWindow();
      if (this.timer === null) this.recordTime(elapsed);
      return;
    }
    // Frames overlap on a GPU, so the interval bounds their time; a CPU draws one at a time.
    const interval = now - previousDone;
    if (this.timer === null) this.recordTime(software ? elapsed : Math.min(elapsed, interval));
    if (this.fixedScale !== null) return;
    const renderTime = this.timer === null ? elapsed : (this.frameTime ?? elapsed);
    if (this.resolution.addFrame(this.budget, renderTime, software ? interval : renderTime)) this.dirty = true;
  }

  private recordTime(milliseconds: number): void {
    if (this.trials <= COLD_FRAMES) return;
    this.frameTime = this.frameTime === null ? milliseconds : this.frameTime * 0.85 + milliseconds * 0.15;
  }

  private makeTimer(): GpuTimer | null {
    const extension = timerExtension(this.gl, this.gpu.capabilities);
    return extension && new GpuTimer(this.gl, extension);
  }
}
