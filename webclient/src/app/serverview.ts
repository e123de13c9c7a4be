/** Frames that the server draws, for browsers that cannot: one request at a time, always for the latest view. */
import { type Api, ApiError, type FrameRequest } from "../api";
import { equal, type Json } from "../scene/json";
import { element } from "../ui/dom";
import { type Display, type DisplayEvents, type FrameTiming, pixelRatio, type ViewState } from "./display";
import type { LoadedPlan, PlanLoader } from "./planloader";
import { DynamicResolution, type FrameBudget } from "./resolution";

/** Time from request to picture that is aimed at in motion, ms. */
const BUDGET: FrameBudget = [
  [0.25, 500],
  [0.5, 300],
  [1, 200],
];
/** Least scale in motion: below it, latency and not the number of pixels takes the time. */
const LEAST_SCALE = 0.25;
const FIRST_SCALE = 0.5;
/** Greatest size of a frame, pixels. */
const MAX_PIXELS = 2_000_000;
/** A picture at rest is sharpened after this long, ms. */
const SHARPENING_DELAY = 300;
/** Delay before a failed request is repeated, ms; it doubles with each failure. */
const RETRY = { first: 1000, longest: 16000 };

/** Over the canvas, which takes the pointer. */
const COVER = "pointer-events-none fixed inset-0 size-full";

export class ServerView implements Display {
  readonly viewport = null;
  dirty = true;
  fixed: number | null = null;
  private readonly root = element("div", { class: `served ${COVER}` });
  private readonly resolution = new DynamicResolution(FIRST_SCALE);
  /** What was requested last, one frame or one for each side. */
  private requested: readonly FrameRequest[] = [];
  private inFlight = false;
  private scale = FIRST_SCALE;
  private failures = 0;
  private retryAt = 0;
  private lastDone = 0;
  private frameTime: number | null = null;
  /** Whether a frame of the current plan was shown. */
  private warm = false;
  private size = { width: 0, height: 0 };
  private frames = 0;
  private readonly recent: number[] = [];

  constructor(
    private readonly api: Api,
    readonly canvas: HTMLCanvasElement,
    private readonly loaders: readonly [PlanLoader, PlanLoader],
    private readonly events: DisplayEvents,
  ) {
    canvas.after(this.root);
    new ResizeObserver(() => (this.dirty = true)).observe(canvas);
  }

  get blank(): boolean {
    return this.root.childElementCount === 0;
  }

  get atRest(): boolean {
    return !this.dirty && !this.inFlight && !this.blank && this.scale >= (this.fixed ?? 1);
  }

  setFixedScale(scale: number | null): void {
    this.fixed = scale;
    this.resetMeasurement();
  }

  tick(now: number, view: ViewState, moving: boolean): void {
    this.root.style.setProperty("--at", `${100 * view.divider}%`);
    if (this.inFlight || now < this.retryAt || this.loaders[0].loaded === null) return;
    const sharpening = !moving && !this.dirty;
    if (sharpening && (this.atRest || now - this.lastDone < SHARPENING_DELAY)) return;
    const scale = this.fixed ?? (sharpening ? 1 : Math.max(LEAST_SCALE, this.resolution.scale));
    const requests = this.requests(view, scale);
    const finest = this.requests(view, this.fixed ?? 1);
    this.dirty = false;
    // Shown already, at this scale or as sharp as it gets.
    if ([requests, finest].some((same) => equal(same as unknown as Json, this.requested as unknown as Json))) return;
    this.requested = requests;
    void this.show(requests, scale, moving);
  }

  timing(): FrameTiming {
    const now = performance.now();
    while (this.recent[0] !== undefined && now - this.recent[0] > 1000) this.recent.shift();
    return { frame: this.frameTime, clock: "server", fps: this.recent.length, ...this.size, scale: this.scale, frames: this.frames };
  }

  load(): null {
    return null;
  }

  resetMeasurement(): void {
    this.resolution.reset(FIRST_SCALE);
    this.frameTime = null;
    this.warm = false;
    this.dirty = true;
  }

  private requests({ time, camera }: ViewState, scale: number): FrameRequest[] {
    const { clientWidth, clientHeight } = this.canvas;
    const fitting = Math.sqrt(MAX_PIXELS / Math.max(1, clientWidth * clientHeight));
    const ratio = scale * Math.min(pixelRatio(), fitting);
    const [width, height] = [clientWidth, clientHeight].map((side) => Math.max(1, Math.round(side * ratio))) as [number, number];
    const { position, yaw, pitch, roll, fov } = camera;
    const request = ({ scene, request: { quality } }: LoadedPlan) => ({
      preset: null, scene, quality, camera: { position: [...position], yaw, pitch, roll, fov }, time, width, height,
    });
    return this.loaders.flatMap(({ loaded }) => (loaded ? [request(loaded)] : []));
  }

  private async show(requests: readonly FrameRequest[], scale: number, moving: boolean): Promise<void> {
    this.inFlight = true;
    const start = performance.now();
    try {
      const images: HTMLImageElement[] = [];
      for (const request of requests) images.push(await decoded(await this.api.frame(request)));
      this.root.replaceChildren(...images);
      this.failures = 0;
      this.scale = scale;
      const { width = 0, height = 0 } = requests[0] ?? {};
      this.size = { width, height };
      this.measure(performance.now() - start, moving);
      this.events.frameDone();
    } catch (error) {
      this.failed(error);
    } finally {
      this.inFlight = false;
    }
  }

  private measure(elapsed: number, moving: boolean): void {
    const now = performance.now();
    this.lastDone = now;
    this.frames += 1;
    this.recent.push(now);
    // The first frame of a plan waits for its programs.
    if (this.warm) this.frameTime = this.frameTime === null ? elapsed : this.frameTime * 0.7 + elapsed * 0.3;
    this.warm = true;
    if (moving && this.fixed === null) this.resolution.addFrame(BUDGET, elapsed, elapsed);
  }

  /** What the server refuses is not asked again; else the request is repeated, and only the first failure is told. */
  private failed(error: unknown): void {
    const refused = error instanceof ApiError && error.status >= 400 && error.status < 500;
    if (!refused) {
      this.retryAt = performance.now() + Math.min(RETRY.longest, RETRY.first * 2 ** this.failures);
      this.failures += 1;
      this.requested = [];
      this.dirty = true;
    }
    if (refused || this.failures === 1) this.events.failed(error);
  }
}

/** The picture, decoded: it replaces the previous one without a gap. */
async function decoded(frame: Blob): Promise<HTMLImageElement> {
  const url = URL.createObjectURL(frame);
  const image = element("img", { class: `${COVER} object-cover not-first:[clip-path:inset(0_0_0_var(--at))]`, src: url, alt: "" });
  try {
    await image.decode();
  } finally {
    URL.revokeObjectURL(url);
  }
  return image;
}
