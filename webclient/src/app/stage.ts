/** The canvas: owns the GPU, draws one picture or two side by side, measures how long it takes. */
import type { CameraState } from "../camera/state";
import { type Gpu, openContext, openGpu } from "../gl/gpu";
import { GpuTimer } from "../gl/timer";
import type { Frame, Rectangle } from "../plan/executor";
import type { Pacing } from "./front";
import { type Law, ON_CPU, onGpu, Pace } from "./pace";
import type { Slot } from "./slot";

/** More pixels than two a point cost much and show nothing. */
const MAX_PIXEL_RATIO = 2;
/** Where the CPU draws, the first frame of a picture is not tried at full size: a frame of seconds would lose the context. */
const SOFTWARE_SCALE = 0.5;
/** A display's interval until it is measured, and the animation frames of which the shortest tells it, ms. */
const DISPLAY = 1000 / 60;
const DISPLAY_FRAMES = 40;
/** Time between two looks at a fence, ms; browsers make it 4 after the first few. */
const LOOK = 1;
/** Spans of frames at one scale after which what was measured is believed. */
const STEADY = 2;
/** Spans after which it is believed on a machine that never settles, since others keep it busy. */
const RESTLESS = 5;
/** The share of a frame's usual time in which nobody asks. */
const UNWATCHED = 0.6;
/** Frames drawn at rest to learn what one costs. */
const TRIALS = 6;
/** The first of them pay for new targets, and some drivers for compiling. */
const COLD = 2;
/** A still picture grows sharper in steps, until the next one would take longer than this, ms. */
const PATIENCE = 3000;
const SHARPER = 2;
const REST = 500;

export interface View {
  time: number;
  camera: CameraState;
  /** Where the right picture begins, as a share of the width; 1 where there is only one. */
  divider: number;
}

export interface Timing {
  /** ms; null until measured. */
  frame: number | null;
  /** Whether the GPU's own clock measured it. */
  measuredByGpu: boolean;
  fps: number;
  width: number;
  height: number;
  scale: number;
  /** Frames since the page opened. */
  frames: number;
}

export interface StageEvents {
  lost(): void;
  restored(): void;
  failed(error: unknown): void;
  /** A frame has left the GPU. */
  drawn(): void;
}

interface Flight {
  /** Before the frame's first command: what was signalled until then was not this frame's work. */
  before: WebGLSync | null;
  after: WebGLSync;
  start: number;
  scale: number;
  /** Drawn because nothing moved: its time says nothing about motion. */
  resting: boolean;
}

export class Stage {
  readonly gl: WebGL2RenderingContext;
  gpu: Gpu;
  /** Something changed that the picture shows. */
  dirty = true;
  private timer: GpuTimer | null = null;
  private readonly pace = new Pace();
  private readonly flights: Flight[] = [];
  private readonly drawn: number[] = [];
  private frameTime: number | null = null;
  private lastDraw = 0;
  /** When the latest frame in motion left the GPU; null after a pause. */
  private lastOut: number | null = null;
  private looking = false;
  private frames = 0;
  private fixedScale: number | null = null;
  /** ms; the shortest of the latest intervals between animation frames. */
  private display = DISPLAY;
  private shortest = { interval: Infinity, frames: 0 };
  private lastTick = 0;
  /** Of the latest frame. */
  private scale = 1;
  /** Of the latest frame that has left the GPU. */
  private finished: { scale: number; milliseconds: number } | null = null;
  /** Frames since the picture became another one. */
  private trials = 0;
  /** How much work wants the GPU to itself. */
  private held = 0;

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly slots: readonly [Slot, Slot],
    private readonly hidden: ReadonlySet<string>,
    private readonly events: StageEvents,
  ) {
    this.gl = openContext(canvas);
    this.gpu = openGpu(this.gl, hidden);
    this.timer = this.makeTimer();
    canvas.addEventListener("webglcontextlost", (event) => {
      // Without this the browser never offers the context again.
      event.preventDefault();
      this.flights.length = 0;
      this.events.lost();
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.gpu = openGpu(this.gl, this.hidden);
      this.timer = this.makeTimer();
      this.dirty = true;
      this.events.restored();
    });
    new ResizeObserver(() => (this.dirty = true)).observe(canvas);
  }

  /** Whether the picture shows everything asked for, as sharp as it will be, and has left the GPU. */
  get atRest(): boolean {
    return !this.dirty && this.flights.length === 0 && !this.unmeasured && this.sharperScale() === null;
  }

  /** The scale that was fixed; null where it is found. */
  get fixed(): number | null {
    return this.fixedScale;
  }

  /** The scale to draw at, whatever it takes; null: found from the times of frames. */
  fix(scale: number | null): void {
    if (scale === this.fixedScale) return;
    this.fixedScale = scale;
    this.reconsider();
  }

  /** Call once an animation frame; draws where there is something new to show. `moving`: more frames will follow. */
  tick(now: number, view: View, moving: boolean): void {
    if (this.gl.isContextLost()) return;
    this.clockDisplay(now);
    this.collect();
    if (this.held > 0) return;
    const resting = !moving && !this.dirty && !this.unmeasured;
    if (!moving) this.lastOut = null;
    const [left] = this.slots;
    const { software } = this.gpu.capabilities;
    // A CPU gains nothing by a second frame under way, and the compositor's work between the two could not be told from theirs.
    if (left.ready === null || this.flights.length > (software ? 0 : 1)) return;
    const scale = resting ? this.sharperScale() : (this.fixedScale ?? this.pace.scale);
    if (scale === null || (resting && now - this.lastDraw < REST)) return;
    this.dirty = false;
    this.lastDraw = now;
    this.trials += 1;
    this.scale = scale;
    this.fit(scale);
    const before = software ? this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0) : null;
    this.timer?.begin();
    this.draw(view);
    this.timer?.end();
    const after = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
    if (after) this.flights.push({ before, after, start: performance.now(), scale, resting });
    this.look();
  }

  /** Asks about the fences again and again, since an animation frame may come long after the water is done. */
  private look(after = LOOK): void {
    if (this.looking) return;
    this.looking = true;
    setTimeout(() => {
      this.looking = false;
      if (this.gl.isContextLost()) return;
      const waited = this.flights[0]?.before !== null;
      this.collect();
      const [flight] = this.flights;
      if (flight === undefined) return;
      // Begun just now: there is nothing to see for most of what a frame takes.
      this.look(waited && flight.before === null ? UNWATCHED * (this.frameTime ?? 0) : LOOK);
    }, after);
  }

  /** The display's interval is the shortest that animation frames come at. */
  private clockDisplay(now: number): void {
    const { shortest } = this;
    if (this.lastTick > 0 && now > this.lastTick) shortest.interval = Math.min(shortest.interval, now - this.lastTick);
    this.lastTick = now;
    shortest.frames += 1;
    if (shortest.frames < DISPLAY_FRAMES) return;
    this.display = Math.min(2 * DISPLAY, Math.max(DISPLAY / 4, shortest.interval));
    this.shortest = { interval: Infinity, frames: 0 };
  }

  /** Draws at full size and gives the picture as a PNG. */
  async png(view: View): Promise<Blob> {
    this.fit(1);
    this.draw(view);
    this.dirty = true;
    // The drawing buffer is only there until the browser takes it: no await before this.
    return new Promise((resolve, reject) =>
      this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the picture could not be encoded"))), "image/png"),
    );
  }

  /** Runs work that is timed: the page's own frames have left the GPU, and none is drawn until it is done. */
  async alone<T>(work: () => Promise<T>): Promise<T> {
    this.held += 1;
    try {
      while (this.flights.length > 0) await new Promise((resolve) => setTimeout(resolve, 4));
      return await work();
    } finally {
      this.held -= 1;
    }
  }

  timing(): Timing {
    const now = performance.now();
    while (this.drawn[0] !== undefined && now - this.drawn[0] > 1000) this.drawn.shift();
    return {
      frame: this.frameTime,
      measuredByGpu: this.timer !== null,
      fps: this.drawn.length,
      width: this.canvas.width,
      height: this.canvas.height,
      scale: this.scale,
      frames: this.frames,
    };
  }

  /** What the picture in motion takes, once its scale has settled or will not; null before, and where the scale is fixed. */
  pacing(): Pacing | null {
    const settled = this.pace.steady >= STEADY || this.pace.spans >= RESTLESS;
    if (this.fixedScale !== null || this.frameTime === null || !settled) return null;
    const { software } = this.gpu.capabilities;
    const [across, down] = [this.canvas.clientWidth, this.canvas.clientHeight];
    return {
      law: this.law,
      scale: this.pace.scale,
      water: this.frameTime,
      rest: software ? this.pace.rest : 0,
      pixels: 1e-6 * across * down * this.ratio ** 2,
    };
  }

  /** The picture became another one, so what was measured says little about it. `expected`: the scale that it should manage. */
  reconsider(expected: number | null = null): void {
    const samples = Math.max(...this.slots.map((slot) => slot.plan?.samples ?? 1));
    this.pace.reconsider(expected ?? (this.gpu.capabilities.software ? SOFTWARE_SCALE / Math.sqrt(samples) : 1));
    this.frameTime = null;
    this.lastOut = null;
    this.trials = 0;
    this.dirty = true;
  }

  private draw({ time, camera, divider }: View): void {
    const { width, height } = this.canvas;
    const [left, right] = this.slots;
    const frame: Frame = { time, camera, width, height, screen: null, scissor: null, scene: null };
    try {
      if (right.ready === null) {
        left.ready?.executor.draw({ ...frame, scene: left.ready.scene });
        return;
      }
      const x = Math.round(width * divider);
      const parts: [Slot, Rectangle][] = [
        [left, { x: 0, y: 0, width: x, height }],
        [right, { x, y: 0, width: width - x, height }],
      ];
      for (const [slot, scissor] of parts) {
        if (slot.ready && scissor.width > 0) slot.ready.executor.draw({ ...frame, scissor, scene: slot.ready.scene });
      }
    } catch (error) {
      this.slots.forEach((slot) => slot.clear());
      this.events.failed(error);
    }
  }

  private get unmeasured(): boolean {
    return this.frameTime === null && this.trials < TRIALS;
  }

  /** The scale at which a picture at rest is worth another frame; null where it is as sharp as it will be. */
  private sharperScale(): number | null {
    const { finished } = this;
    if (this.fixedScale !== null || finished === null || finished.scale !== this.scale || this.scale >= 1) return null;
    const next = Math.min(1, this.scale * SHARPER);
    return finished.milliseconds * (next / this.scale) ** 2 > PATIENCE ? null : next;
  }

  /** Pixels a point at full resolution. */
  private get ratio(): number {
    return Math.min(window.devicePixelRatio, MAX_PIXEL_RATIO);
  }

  private get law(): Law {
    return this.gpu.capabilities.software ? ON_CPU : onGpu(this.display);
  }

  private fit(scale: number): void {
    const ratio = this.ratio * scale;
    const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    // Setting a canvas's size clears it, even to the same size.
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
  }

  /** Takes note of the frames that have left the GPU. */
  private collect(): void {
    const { gl } = this;
    const out = (fence: WebGLSync) => gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED;
    for (let flight = this.flights[0]; flight !== undefined; flight = this.flights[0]) {
      if (flight.before !== null && out(flight.before)) {
        gl.deleteSync(flight.before);
        flight.before = null;
        flight.start = performance.now();
      }
      if (!out(flight.after)) break;
      gl.deleteSync(flight.after);
      this.flights.shift();
      this.takeNote(flight, performance.now());
      this.events.drawn();
    }
    const measured = this.timer?.poll();
    if (typeof measured === "number") this.note(measured);
  }

  private takeNote({ start, scale, resting }: Flight, now: number): void {
    const { software } = this.gpu.capabilities;
    const elapsed = now - start;
    this.frames += 1;
    this.drawn.push(now);
    this.finished = { scale, milliseconds: elapsed };
    const before = this.lastOut;
    this.lastOut = resting ? null : now;
    if (resting) return;
    if (before === null) {
      // The first frame after a pause has no interval.
      this.pace.begin();
      if (this.timer === null) this.note(elapsed);
      return;
    }
    // Frames overlap on a GPU: what counts is from one to the next. A CPU draws one at a time.
    if (this.timer === null) this.note(software ? elapsed : Math.min(elapsed, now - before));
    if (this.fixedScale !== null) return;
    const water = this.timer === null ? elapsed : (this.frameTime ?? elapsed);
    if (this.pace.frame(this.law, water, software ? now - before : water)) this.dirty = true;
  }

  private note(milliseconds: number): void {
    if (this.trials <= COLD) return;
    this.frameTime = this.frameTime === null ? milliseconds : this.frameTime * 0.85 + milliseconds * 0.15;
  }

  private makeTimer(): GpuTimer | null {
    const { extensions, software } = this.gpu.capabilities;
    if (software || !extensions.has("EXT_disjoint_timer_query_webgl2")) return null;
    const extension = this.gl.getExtension("EXT_disjoint_timer_query_webgl2") as ConstructorParameters<
      typeof GpuTimer
    >[1] | null;
    return extension && new GpuTimer(this.gl, extension);
  }
}
