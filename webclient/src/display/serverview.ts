/** Frames that the server draws: a stream while the picture moves, the exact picture at rest. */
import { type Api, ApiError, type FrameRequest, messageOf, type StreamView } from "../api";
import { equal, type Json } from "../scene/json";
import { element } from "../ui/dom";
import { type Display, type DisplayEvents, type FrameTiming, onPixelsChange, pixelRatio, pixelSize, pixelsOf, type Rate, resizeCanvas, ShownFrames, type ViewState } from "./display";
import { bestScale, type FrameBudget, type RenderLoad } from "./framebudget";
import type { PlanLoader, PlanRequest, PlanView } from "./planloader";
import { DynamicResolution } from "./resolution";

const MARGIN = 0.9; // Share of the time without a request after which a stream counts as ended

export class FrameStream {
  private id: Promise<string> | null = null;
  private shows: PlanRequest | null = null;
  private ends = Infinity; // When it ends unless it is asked for a frame, ms of performance.now()
  private lease = Infinity;
  private asked = 0;
  private closed = Promise.resolve(); // The last stream's end: its place is free then
  private closing = new AbortController();

  constructor(private readonly api: Api) {}

  /** A frame of a scene, or null if it was given up, for later ones or with the stream; rejects with the server's refusal. */
  async frame(scene: Json, quality: Json, view: StreamView): Promise<Blob | null> {
    // Browsers log it where a stream that has ended is asked for. None ends while a frame is drawn.
    if (this.asked === 0 && performance.now() > this.ends) this.close();
    const { signal } = this.closing;
    this.asked += 1;
    try {
      const id = await this.open({ scene, quality });
      signal.throwIfAborted();
      return await this.api.streamFrame(id, view, signal);
    } catch (error) {
      if (signal.aborted) return null;
      // It was not asked for long enough to end: the next frame opens another.
      if (error instanceof ApiError && error.status === 404) this.id = null;
      throw error;
    } finally {
      this.asked -= 1;
      this.ends = performance.now() + this.lease;
    }
  }

  close(): void {
    if (this.id === null) return;
    // Browsers log a frame that the server is asked for after the stream's end.
    this.closing.abort();
    this.closing = new AbortController();
    this.closed = this.id.then((id) => this.api.closeStream(id), () => undefined);
    this.id = this.shows = null;
    this.ends = Infinity;
  }

  private open(wanted: PlanRequest): Promise<string> {
    const { id, shows } = this;
    if (id !== null && shows && equal(shows.scene, wanted.scene) && equal(shows.quality, wanted.quality)) return id;
    this.shows = wanted;
    const opened = id === null ? this.begin(wanted) : id.then((known) => this.change(known, wanted));
    this.id = opened;
    opened.catch(() => {
      if (this.id === opened) this.id = null;
    });
    return opened;
  }

  private async begin({ scene, quality }: PlanRequest): Promise<string> {
    await this.closed;
    const { id, lease } = await this.api.openStream(scene, quality);
    this.lease = MARGIN * 1000 * lease;
    return id;
  }

  private async change(id: string, wanted: PlanRequest): Promise<string> {
    try {
      await this.api.changeStream(id, wanted.scene, wanted.quality);
      return id;
    } catch (error) {
      if (error instanceof ApiError && error.status === 404) return this.begin(wanted);
      throw error;
    }
  }
}

/** Time from frame to frame, ms, by scale: it is the server's, and blocks nothing here. */
const BUDGET: FrameBudget = [[0.5, 240], [0.52, 62], [0.6, 57], [1, 54]];
const LEAST_SCALE = 0.4; // Below this scale fewer frames a second are better than fewer pixels
/** While the camera moves an answer within a quarter of a second is worth more than pixels: a frame that is begun comes first. */
const TURNING: { budget: FrameBudget; least: number } = { budget: [[1, 120]], least: 0.25 };
const FIRST_SHARE = 0.25; // Share of the pixels of the first frame: a scale of 0.5
const MAX_PIXELS = 2_000_000; // Greatest size of a frame, pixels
const DEPTH = 2; // Frames that are asked for before the first of them has come
/** While the camera moves, a frame that waits at the server gives way to one of the newest view this often, ms. */
const NEW_VIEW_INTERVAL = 60;
const SHARPENING_DELAY = 300; // A picture at rest is sharpened after this long, ms
/** Delay before a failed request is repeated, ms; it doubles with each failure. */
const RETRY = { first: 1000, longest: 16000 };
const SETTLED_WINDOWS = 3; // Windows that are measured before the rate counts

const COVER = "pointer-events-none fixed inset-0 size-full"; // Over the canvas, which takes the pointer

interface RequestedFrame { number: number; submitted: number; scale: number; moving: boolean; tier: string | null; }

export class ServerView implements Display {
  readonly gpu = null;
  dirty = true;
  fixed: number | null = null;
  stalled: string | null = null;
  retryAt = 0; // When to ask for it again, ms of performance.now()
  private readonly root = element("div", { class: `served ${COVER}` });
  private readonly resolution: DynamicResolution;
  private readonly streams: readonly [FrameStream, FrameStream];
  private readonly shown = new ShownFrames();
  private readonly pending: RequestedFrame[] = []; // Frames that were asked for and have not come
  private number = 0;
  private latest = 0;
  private exact: readonly FrameRequest[] = []; // The exact picture that was asked for last, one for each side
  private view: string = "";
  private lastNewView = 0;
  private scale = 0;
  private failures = 0;
  private waitUntil = 0;
  private lastMotion = -Infinity;
  private divider = NaN;
  private size = { width: 0, height: 0 };
  private frameTime: number | null = null;
  private tier: string | null = null; // Of the picture that is shown, if it is not the selection's

  constructor(
    private readonly api: Api,
    readonly canvas: HTMLCanvasElement,
    private readonly loaders: readonly [PlanLoader, PlanLoader],
    private readonly events: DisplayEvents,
  ) {
    canvas.after(this.root);
    const pixels = pixelsOf(canvas);
    this.resolution = new DynamicResolution(pixels, BUDGET, FIRST_SHARE * pixels, LEAST_SCALE);
    this.streams = [new FrameStream(api), new FrameStream(api)];
    onPixelsChange(canvas, () => (this.dirty = true));
    window.addEventListener("pagehide", () => this.close());
  }

  get blank(): boolean { return this.root.childElementCount === 0; }

  get presentable(): boolean { return !this.blank; }

  get atRest(): boolean {
    return !this.dirty && this.pending.length === 0 && !this.blank && this.scale >= (this.fixed ?? 1);
  }

  setFixedScale(scale: number | null): void {
    this.fixed = scale;
    this.resolution.pause();
    this.dirty = true;
  }

  /** Takes the picture away and gives the streams back: something else draws. */
  close(): void {
    for (const stream of this.streams) stream.close();
    this.pending.length = 0;
    this.latest = this.number + 1;
    this.stalled = null;
  }

  hide(): void {
    this.root.replaceChildren();
    this.scale = 0;
  }

  tick(now: number, view: ViewState, moving: boolean): void {
    // Set each time, it would have the browser put the page together anew at the display's rate.
    if (view.divider !== this.divider) this.root.style.setProperty("--at", `${100 * (this.divider = view.divider)}%`);
    if (moving) this.lastMotion = now;
    else this.resolution.pause();
    if (now < this.waitUntil || this.loaders[0].view === null) return;
    if (moving && now >= this.retryAt) this.stream(now, view);
    else if (this.pending.length === 0) this.rest(now, view);
  }

  timing(): FrameTiming {
    return { frame: this.resolution.measured ?? this.frameTime, fps: this.shown.fps, ...this.size, scale: this.scale, frames: this.shown.total, tier: this.tier };
  }

  rate(): Rate | null {
    const { measured, windows, scale } = this.resolution;
    return this.fixed !== null || measured === null || windows < SETTLED_WINDOWS ? null : { scale, fps: 1000 / measured };
  }

  load(): RenderLoad | null {
    const { cost, scale, displayInterval } = this.resolution;
    if (this.fixed !== null) return null;
    return { cost: this.rate() && cost, scale, displayInterval, budget: BUDGET, megapixels: 1e-6 * pixelsOf(this.canvas) };
  }

  planChanged(cost: number): void {
    this.resolution.expect(cost);
    this.exact = [];
    this.dirty = true;
  }

  /** Asks for the next frame in motion, if there is a place for it. */
  private stream(now: number, view: ViewState): void {
    const camera = JSON.stringify(view.camera);
    const isNewView = camera !== this.view && now - this.lastNewView > NEW_VIEW_INTERVAL && this.pending.length === DEPTH;
    if (this.pending.length >= DEPTH && !isNewView) return;
    const tier = this.movingTier();
    if (tier === undefined) return;
    if (isNewView) this.lastNewView = now;
    const scale = this.fixed ?? (camera === this.view ? this.resolution.scale : this.turningScale);
    this.view = camera;
    this.dirty = false;
    const frame = this.frame(view, scale);
    // A picture without a divider leaves the other side's place to others.
    for (const stream of this.streams.slice(this.views.length)) stream.close();
    const take = () => Promise.all(this.views.map(({ scene, request }, side) => (this.streams[side] as FrameStream).frame(scene, tier ?? request.quality, frame)));
    void this.show(take, { ...frame, scale, moving: true, tier });
  }

  /** Asks for the exact picture of a view that does not move, small while it changes. */
  private rest(now: number, view: ViewState): void {
    const sharpening = !this.dirty;
    if (sharpening && (this.atRest || now - this.lastMotion < SHARPENING_DELAY)) return;
    const scale = this.fixed ?? (sharpening ? 1 : this.resolution.scale);
    const requests = this.requests(view, scale);
    const finest = this.requests(view, this.fixed ?? 1);
    this.dirty = false;
    // Shown already, at this scale or as sharp as it gets.
    if ([requests, finest].some((same) => equal(same as unknown as Json, this.exact as unknown as Json))) return;
    this.exact = requests;
    const take = () => Promise.all(requests.map((request) => this.api.frame(request)));
    void this.show(take, { ...this.frame(view, scale), scale, moving: false, tier: null });
  }

  /** The tier for the next frame in motion; null: as selected; undefined: not known yet. */
  private movingTier(): string | null | undefined {
    const load = this.load();
    const chosen = load && this.events.movingTier(load);
    if (chosen === undefined) return undefined;
    // What is not measured yet starts small, whatever the tier.
    if (load?.cost && chosen && chosen.cost !== 1) this.resolution.expect(chosen.cost);
    return chosen?.tier ?? null;
  }

  private get turningScale(): number {
    const { cost, scale, displayInterval } = this.resolution;
    return cost === null ? scale : Math.min(scale, Math.max(TURNING.least, bestScale(cost, displayInterval, TURNING.budget)));
  }

  private get views(): PlanView[] { return this.loaders.flatMap(({ view }) => view ?? []); }

  private requests(view: ViewState, scale: number): FrameRequest[] {
    return this.views.map(({ scene, request: { quality } }) => ({ preset: null, scene, quality, ...this.frame(view, scale) }));
  }

  private frame({ time, camera }: ViewState, scale: number): StreamView {
    const { clientWidth, clientHeight } = this.canvas;
    const fitting = Math.sqrt(MAX_PIXELS / Math.max(1, clientWidth * clientHeight));
    const ratio = scale * Math.min(pixelRatio(), fitting);
    const [width, height] = pixelSize(this.canvas, ratio);
    return { camera, time, width, height };
  }

  private async show(take: () => Promise<(Blob | null)[]>, { scale, moving, tier, width, height }: StreamView & Pick<RequestedFrame, "scale" | "moving" | "tier">): Promise<void> {
    const frame: RequestedFrame = { number: ++this.number, submitted: performance.now(), scale, moving, tier };
    this.pending.push(frame);
    try {
      const blobs = (await take()).filter((blob) => blob !== null);
      // Decoded off the main thread.
      const pictures = await Promise.all(blobs.map((blob) => createImageBitmap(blob)));
      // What comes after a later frame, or was given up for one, is not shown.
      if (frame.number < this.latest || pictures.length < this.views.length) {
        pictures.forEach((picture) => picture.close());
        return;
      }
      this.latest = frame.number;
      this.present(pictures);
      this.size = { width, height };
      this.measure(frame);
      this.failures = 0;
      this.stalled = null;
      this.scale = scale;
      this.tier = tier;
      if (moving) this.exact = [];
      this.events.frameDone();
    } catch (error) {
      if (frame.number > this.latest) this.failed(error, moving);
    } finally {
      const index = this.pending.indexOf(frame);
      if (index >= 0) this.pending.splice(index, 1);
    }
  }

  private present(pictures: readonly ImageBitmap[]): void {
    while (this.root.childElementCount > pictures.length) this.root.lastElementChild?.remove();
    while (this.root.childElementCount < pictures.length) this.root.append(element("canvas", { class: `${COVER} object-cover not-first:[clip-path:inset(0_0_0_var(--at))]` }));
    pictures.forEach((picture, side) => {
      const canvas = this.root.children[side] as HTMLCanvasElement;
      resizeCanvas(canvas, picture.width, picture.height);
      canvas.getContext("bitmaprenderer")?.transferFromImageBitmap(picture);
    });
  }

  private measure({ submitted, scale, moving }: RequestedFrame): void {
    const done = performance.now();
    this.shown.add();
    this.frameTime = done - submitted;
    if (moving && this.fixed === null) this.resolution.addFrame({ scale, submitted, done });
  }

  /** What the server refuses is not asked again; else the request is repeated, and only the first failure is told. */
  private failed(error: unknown, moving: boolean): void {
    const { status, retryAfter } = error instanceof ApiError ? error : { status: 0, retryAfter: 0 };
    if (moving) this.resolution.pause();
    const refused = status >= 400 && status < 500 && !(moving && status === 404);
    if (!refused) {
      const delay = Math.min(RETRY.longest, RETRY.first * 2 ** this.failures);
      this.failures += 1;
      this.exact = [];
      this.dirty = true;
      if (moving && retryAfter > 0) {
        // All streams are taken: single pictures until one may be free.
        this.stalled = messageOf(error);
        this.retryAt = performance.now() + 1000 * retryAfter;
        return;
      }
      this.waitUntil = performance.now() + (status === 404 ? 0 : delay);
    }
    if (refused || this.failures === 1) this.events.failed(error);
  }
}
