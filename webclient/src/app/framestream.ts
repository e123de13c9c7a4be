/** One stream of the server's frames: opened when the first is asked for, changed with the scene, opened again if it has ended. */
import { type Api, ApiError, type StreamView } from "../api";
import { equal, type Json } from "../scene/json";

interface Shown {
  scene: Json;
  quality: Json;
}

export class FrameStream {
  private id: Promise<string> | null = null;
  private shows: Shown | null = null;

  constructor(private readonly api: Api) {}

  /** A frame of a scene; rejects with the server's refusal. */
  async frame(scene: Json, quality: Json, view: StreamView): Promise<Blob> {
    const id = await this.open({ scene, quality });
    try {
      return await this.api.streamFrame(id, view);
    } catch (error) {
      // It was not asked for long enough to end: the next frame opens another.
      if (error instanceof ApiError && error.status === 404) this.id = null;
      throw error;
    }
  }

  close(): void {
    this.id?.then((id) => this.api.closeStream(id), () => undefined);
    this.id = this.shows = null;
  }

  private open(wanted: Shown): Promise<string> {
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

  private async begin({ scene, quality }: Shown): Promise<string> {
    return (await this.api.openStream(scene, quality)).id;
  }

  private async change(id: string, wanted: Shown): Promise<string> {
    try {
      await this.api.changeStream(id, wanted.scene, wanted.quality);
      return id;
    } catch (error) {
      if (error instanceof ApiError && error.status === 404) return this.begin(wanted);
      throw error;
    }
  }
}
