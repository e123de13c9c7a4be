/** The canvas: owns the GPU, draws one picture or two side by side, and measures frame times. */
import { type Gpu, openContext, openGpu } from "../gl/gpu";
import { drawsSlowly } from "../gl/speed";
import { makeScreen, type Screen } from "../gl/resources";
import type { Frame } from "../plan/executor";
import { type Display, type DisplayEvents, type FrameTiming, onPixelsChange, pixelRatio, pixelSize, pixelsOf, type Rate, resizeCanvas, ShownFrames, type ViewState } from "./display";
import { MOTION_BUDGET, type RenderLoad } from "./framebudget";
import { DynamicResolution } from "./resolution";
import type { PlanLoader } from "./planloader";

/** The display's interval until it is measured, ms, and the animation frames that one measurement takes. */
const DISPLAY_INTERVAL = 1000 / 60;
const DISPLAY_FRAMES = 40;
const POLL_INTERVAL = 1; // Time between two checks of a fence, ms; browsers raise it to 4 after a few
const UNPOLLED_SHARE = 0.6; // Share of a frame's usual time before its fence is first checked
/** Measured windows after which the scale has settled: with none changed by the last, or in all. */
const SETTLED_WINDOWS = { least: 3, most: 8 };
/** Time after the first frame of a plan by which its rate counts, ms, however few frames were measured. */
const LONGEST_TRIAL = 2000;
/** A moving picture of this scale may take the place of the still, whether or not it grows further. */
const PRESENTABLE_SCALE = 0.4;
const SHARPENING_TIME = 1000; // At rest the scale is raised until the next frame would take longer than this, ms
const SHARPENING_DELAY = 500;

interface DrawnFrame { scale: number; onCanvas: boolean; }

/** `moving`: whether its time is part of the load in motion. */
interface PendingFrame extends DrawnFrame { fence: WebGLSync; submitted: number; moving: boolean; }

export class Viewport implements Display {
  readonly gl: WebGL2RenderingContext;
  gpu: Gpu;
  dirty = true;
  readonly stalled = null;
  fixed: number | null = null;
  private readonly resolution: DynamicResolution;
  private pixels: number; // Pixels at scale 1 for which it has measured
  private firstFinished = Infinity; // When the plan's first frame in motion was done
  private changedAt = 0; // Windows measured when the scale changed last
  private readonly pending: PendingFrame[] = [];
  private readonly shown = new ShownFrames();
  private lastMotion = -Infinity;
  private moving = false;
  private polling = false;
  /** Shortest interval between animation frames in the current measurement. */
  private shortest = { interval: Infinity, frames: 0 };
  private lastTick = 0;
  private scale = 1;
  private finished: (DrawnFrame & { milliseconds: number }) | null = null;
  /** Whether the canvas is drawn to. Before, frames are measured where nobody sees them: browsers that put pages together without a GPU wait for every frame of a canvas. */
  private revealed = false;
  private hidden: Screen | null = null;
  private exclusiveTasks = 0; // How many tasks have exclusive use of the GPU

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly loaders: readonly [PlanLoader, PlanLoader],
    private readonly withheld: ReadonlySet<string>,
    private readonly events: DisplayEvents,
  ) {
    this.gl = openContext(canvas);
    this.gpu = openGpu(this.gl, withheld);
    this.pixels = pixelsOf(canvas);
    this.resolution = new DynamicResolution(this.pixels);
    canvas.addEventListener("webglcontextlost", (event) => {
      // Without this the browser does not restore the context.
      event.preventDefault();
      this.pending.length = 0;
      this.hidden = null;
      this.events.contextLost();
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.gpu = openGpu(this.gl, this.withheld);
      this.dirty = true;
      this.events.contextRestored();
    });
    onPixelsChange(canvas, () => this.resized());
    document.addEventListener("visibilitychange", () => this.resolution.pause());
  }

  get blank(): boolean { return this.loaders[0].loaded === null; }

  get presentable(): boolean { return this.revealed && this.finished?.onCanvas === true && this.good; }

  /** Whether frames are good enough to be seen, or get no better. */
  private get good(): boolean {
    return (!this.moving && this.sharpest) || (this.finished?.scale ?? 0) >= (this.fixed ?? PRESENTABLE_SCALE) || this.settled;
  }

  /** Whether the latest frame shows what was asked for, at its final scale. */
  private get sharpest(): boolean {
    return !this.dirty && this.pending.length === 0 && this.finished !== null && this.sharperScale() === null;
  }

  /** Whether the canvas is up to date at its final scale and the GPU is idle. */
  get atRest(): boolean { return this.sharpest && this.finished?.onCanvas === true; }

  setFixedScale(scale: number | null): void {
    if (scale === this.fixed) return;
    this.fixed = scale;
    this.resolution.pause();
    this.dirty = true;
  }

  tick(now: number, view: ViewState, moving: boolean): void {
    if (this.gl.isContextLost()) return;
    this.measureDisplay(now);
    this.collect();
    if (this.exclusiveTasks > 0) return;
    this.moving = moving;
    if (moving) this.lastMotion = now;
    else this.resolution.pause();
    if (this.loaders[0].loaded === null || this.pending.length >= (moving ? this.resolution.depth : 1)) return;
    const scale = this.nextScale(now, moving);
    if (scale === null) return;
    this.dirty = false;
    this.scale = scale;
    this.revealed ||= this.good;
    const onCanvas = this.revealed;
    const submitted = performance.now();
    this.draw(view, onCanvas ? this.prepareCanvas(scale) : this.prepareHidden(scale));
    const fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
    if (fence) this.pending.push({ fence, submitted, scale, moving, onCanvas });
    this.poll(UNPOLLED_SHARE * (this.resolution.measured ?? 0));
  }

  private nextScale(now: number, moving: boolean): number | null {
    if (moving || this.dirty) return this.fixed ?? this.resolution.scale;
    // What was good where nobody saw it is drawn once more, on the canvas.
    if (this.finished?.onCanvas === false && this.good) return this.finished.scale;
    return now - this.lastMotion < SHARPENING_DELAY ? null : this.sharperScale();
  }

  /** Checks the fences between animation frames, which may come long after the GPU is done. */
  private poll(delay: number): void {
    if (this.polling) return;
    this.polling = true;
    setTimeout(() => {
      this.polling = false;
      if (this.gl.isContextLost()) return;
      this.collect();
      if (this.pending.length > 0) this.poll(POLL_INTERVAL);
    }, delay);
  }

  private measureDisplay(now: number): void {
    const { shortest } = this;
    if (this.lastTick > 0 && now > this.lastTick) shortest.interval = Math.min(shortest.interval, now - this.lastTick);
    this.lastTick = now;
    shortest.frames += 1;
    if (shortest.frames < DISPLAY_FRAMES) return;
    this.resolution.displayInterval = Math.min(2 * DISPLAY_INTERVAL, Math.max(DISPLAY_INTERVAL / 4, shortest.interval));
    this.shortest = { interval: Infinity, frames: 0 };
  }

  /** Draws at scale 1 and returns a PNG. */
  async png(view: ViewState): Promise<Blob> {
    this.draw(view, this.prepareCanvas(1));
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
      this.resolution.pause();
    }
  }

  timing(): FrameTiming {
    const { scale, shown } = this;
    const [width, height] = this.sizeAt(scale);
    const frame = this.resolution.measured ?? this.finished?.milliseconds ?? null;
    return { frame, fps: shown.fps, width, height, scale, frames: shown.total, tier: null };
  }

  rate(): Rate | null {
    const { measured, displayInterval, scale } = this.resolution;
    const milliseconds = measured ?? this.finished?.milliseconds;
    if (this.fixed !== null || milliseconds === undefined || !this.settled) return null;
    return { scale, fps: 1000 / Math.max(milliseconds, displayInterval) };
  }

  /** The load in motion; null until it is measured, and while the scale is fixed. */
  load(): RenderLoad | null {
    const { cost, scale, displayInterval } = this.resolution;
    if (this.fixed !== null || cost === null || !this.settled) return null;
    return { cost, scale, displayInterval, budget: MOTION_BUDGET, megapixels: 1e-6 * this.pixels };
  }

  /** Whether it would draw at a processor's speed, as far as can be told before a plan is compiled. */
  async slow(): Promise<boolean> {
    // The timers of a hidden page tell nothing.
    return !document.hidden && this.runExclusive(() => drawsSlowly(this.gl));
  }

  planChanged(cost: number): void {
    this.resolution.expect(cost);
    this.changedAt = 0;
    this.firstFinished = Infinity;
    this.dirty = true;
  }

  private get settled(): boolean {
    const { windows } = this.resolution;
    // Of frames that take so long few are measured.
    if (this.moving && performance.now() - this.firstFinished > LONGEST_TRIAL) return true;
    return windows >= SETTLED_WINDOWS.most || (windows >= SETTLED_WINDOWS.least && windows > this.changedAt);
  }

  private resized(): void {
    const pixels = pixelsOf(this.canvas);
    if (pixels !== this.pixels && pixels > 0) {
      this.resolution.expect(pixels / Math.max(1, this.pixels), false);
      this.pixels = pixels;
    }
    this.dirty = true;
  }

  private draw({ time, camera, divider }: ViewState, picture: Pick<Frame, "width" | "height" | "screen">): void {
    const { width, height } = picture;
    const [left, right] = this.loaders;
    const frame: Frame = { time, camera, ...picture, scissor: null, scene: null };
    try {
      if (right.loaded === null) {
        left.loaded?.executor?.draw({ ...frame, scene: left.loaded.scene });
        return;
      }
      const x = Math.round(width * divider);
      const parts = [[left, { x: 0, y: 0, width: x, height }], [right, { x, y: 0, width: width - x, height }]] as const;
      for (const [{ loaded }, scissor] of parts) {
        if (loaded && scissor.width > 0) loaded.executor?.draw({ ...frame, scissor, scene: loaded.scene });
      }
    } catch (error) {
      this.loaders.forEach((loader) => loader.clear());
      this.events.failed(error);
    }
  }

  /** The next scale to sharpen a still picture with; null if the current one is final. */
  private sharperScale(): number | null {
    const { finished, scale } = this;
    if (this.fixed !== null || finished === null || finished.scale !== scale || scale >= 1) return null;
    const next = Math.min(1, scale * Math.sqrt(SHARPENING_TIME / Math.max(1, finished.milliseconds)));
    return next > 1.1 * scale || next === 1 ? next : null;
  }

  private sizeAt(scale: number): [number, number] {
    return pixelSize(this.canvas, pixelRatio() * scale);
  }

  private prepareCanvas(scale: number): Pick<Frame, "width" | "height" | "screen"> {
    const [width, height] = this.sizeAt(scale);
    resizeCanvas(this.canvas, width, height);
    this.hidden?.dispose();
    this.hidden = null;
    return { width, height, screen: null };
  }

  private prepareHidden(scale: number): Pick<Frame, "width" | "height" | "screen"> {
    const [width, height] = this.sizeAt(scale);
    if (this.hidden?.width !== width || this.hidden.height !== height) {
      this.hidden?.dispose();
      this.hidden = makeScreen(this.gl, width, height);
    }
    return { width, height, screen: this.hidden.framebuffer };
  }

  /** Removes pending frames that the GPU has finished and records their times. */
  private collect(): void {
    const { gl } = this;
    for (let frame = this.pending[0]; frame !== undefined; frame = this.pending[0]) {
      if (gl.getSyncParameter(frame.fence, gl.SYNC_STATUS) !== gl.SIGNALED) break;
      gl.deleteSync(frame.fence);
      this.pending.shift();
      this.record(frame, performance.now());
      this.events.frameDone();
    }
  }

  private record({ submitted, scale, moving, onCanvas }: PendingFrame, done: number): void {
    if (onCanvas) this.shown.add();
    this.finished = { scale, onCanvas, milliseconds: done - submitted };
    if (moving) this.firstFinished = Math.min(this.firstFinished, done);
    if (!moving || this.fixed !== null || this.exclusiveTasks > 0) return;
    if (!this.resolution.addFrame({ scale, submitted, done })) return;
    this.changedAt = this.resolution.windows;
    this.dirty = true;
  }
}
