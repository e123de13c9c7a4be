/** One stream of the server's frames: opened when the first is asked for, changed with the scene, opened again if it has ended. */
import { type Api, ApiError, type StreamView } from "../api";
import { equal, type Json } from "../scene/json";
import type { PlanRequest } from "./planloader";

/** Share of the time without a request after which a stream counts as ended. */
const MARGIN = 0.9;

export class FrameStream {
  private id: Promise<string> | null = null;
  private shows: PlanRequest | null = null;
  /** When it ends unless it is asked for a frame, ms of performance.now(). */
  private ends = Infinity;
  private lease = Infinity;
  private asked = 0;
  /** The last stream's end: its place is free then. */
  private closed = Promise.resolve();
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
