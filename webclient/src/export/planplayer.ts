/** Plays one frame plan on a canvas: clock, camera, dynamic resolution. For pages that are not the whole application. */
import { CameraControls, CLEARANCE } from "../camera/controls";
import type { CameraState } from "../camera/state";
import { pixelRatio, pixelSize, pixelsOf, resizeCanvas } from "../display/display";
import { DynamicResolution } from "../display/resolution";
import type { FramePlan } from "../generated/api";
import { type Gpu, openContext, openGpu } from "../gl/gpu";
import { Executor, type LoadBytes } from "../plan/executor";
import type { Json } from "../scene/json";

const SHARPENING_DELAY = 300; // Delay after the last frame in motion before a still picture is drawn at full size, ms

interface PlayerStart {
  plan: FramePlan;
  bytes: LoadBytes;
  time: number; // s
  camera: CameraState;
  playing: boolean;
  reducedMotion: boolean; // Whether the camera moves without inertia
}

export class PlanPlayer {
  readonly controls: CameraControls;
  camera: CameraState;
  time: number; // s
  playing: boolean;
  speed = 1;
  scene: Json | null = null; // Scene whose live fields are drawn; null: as the plan says
  active = true; // False: neither draws nor advances
  /** Called before each frame. */
  beforeFrame: () => void = () => undefined;
  failed: (error: unknown) => void = () => undefined;
  frames = 0;
  private gpu: Gpu;
  private executor: Executor | null = null;
  private readonly resolution: DynamicResolution;
  private pending: { fence: WebGLSync; scale: number; submitted: number } | null = null;
  private lastTick = 0;
  private lastDraw = 0;
  private sharp = false; // Whether the canvas shows the current state at full size
  private dirty = true;
  private disposed = false;
  private readonly resizes: ResizeObserver;

  /** Throws a `CapabilityError` without WebGL 2. */
  constructor(readonly canvas: HTMLCanvasElement, private readonly start: PlayerStart) {
    this.gpu = openGpu(openContext(canvas), new Set());
    this.controls = new CameraControls(canvas, start.camera, !start.reducedMotion);
    this.controls.surface = this.controls.bottom = start.plan.top + CLEARANCE;
    this.camera = start.camera;
    this.time = start.time;
    this.playing = start.playing;
    this.resolution = new DynamicResolution(pixelsOf(canvas));
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.executor = this.pending = null;
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.gpu = openGpu(this.gpu.gl, new Set());
      this.load().catch((error: unknown) => this.failed(error));
    });
    this.resizes = new ResizeObserver(() => this.redraw());
    this.resizes.observe(canvas);
  }

  /** Loads the plan and starts drawing. */
  async load(): Promise<void> {
    const { plan, bytes } = this.start;
    const executor = await Executor.load(this.gpu, plan, bytes, this.camera, true);
    if (this.disposed) {
      executor.dispose();
      return;
    }
    this.executor = executor;
    this.redraw();
    this.lastTick = 0;
    requestAnimationFrame((now) => this.tick(now, executor));
  }

  redraw(): void {
    this.dirty = true;
    this.sharp = false;
  }

  /** Draws at full size and returns a PNG; null before the plan is loaded. */
  async png(): Promise<Blob | null> {
    if (this.executor === null) return null;
    this.draw(this.executor, 1);
    return new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
  }

  dispose(): void {
    this.disposed = true;
    this.resizes.disconnect();
    this.executor?.dispose();
    this.executor = null;
    this.gpu.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }

  private tick(now: number, executor: Executor): void {
    if (this.executor !== executor) return;
    requestAnimationFrame((next) => this.tick(next, executor));
    const seconds = this.lastTick === 0 ? 0 : Math.min(0.25, (now - this.lastTick) / 1000);
    this.lastTick = now;
    if (!this.active) return;
    this.beforeFrame();
    // Another camera may have been set between two frames.
    const cameraMoved = this.controls.step(seconds) || this.camera !== this.controls.camera;
    this.camera = this.controls.camera;
    if (this.playing) this.time += seconds * this.speed;
    if (cameraMoved || this.playing) this.redraw();
    this.collect(now);
    if (this.pending !== null) return;
    const moving = cameraMoved || this.playing;
    if (!moving) this.resolution.pause();
    if (this.dirty) this.draw(executor, this.resolution.scale);
    else if (!moving && !this.sharp && now - this.lastDraw > SHARPENING_DELAY) this.draw(executor, 1);
  }

  private draw(executor: Executor, scale: number): void {
    const { gl } = this.gpu;
    const [width, height] = pixelSize(this.canvas, pixelRatio() * scale);
    resizeCanvas(this.canvas, width, height);
    const submitted = performance.now();
    executor.draw({ time: this.time, camera: this.camera, width, height, screen: null, scissor: null, scene: this.scene });
    this.frames += 1;
    this.lastDraw = submitted;
    this.dirty = false;
    this.sharp = scale === 1;
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    if (this.pending) gl.deleteSync(this.pending.fence);
    this.pending = fence && { fence, scale, submitted };
  }

  /** Takes the time of a frame that the GPU has finished. */
  private collect(now: number): void {
    const { gl } = this.gpu;
    if (this.pending === null || gl.getSyncParameter(this.pending.fence, gl.SYNC_STATUS) !== gl.SIGNALED) return;
    const { fence, scale, submitted } = this.pending;
    gl.deleteSync(fence);
    this.pending = null;
    if (this.playing) this.resolution.addFrame({ scale, submitted, done: now });
  }
}
