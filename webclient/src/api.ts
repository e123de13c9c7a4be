/** Client of the server's REST API. */
import type { CameraState } from "./camera/state";
import type { FramePlan, Texture } from "./generated/api";
import { isObject, type Json, type JsonObject, parsed } from "./scene/json";

export interface PresetSummary {
  name: string;
  group: string;
  title: string;
  summary: string;
  effects: string[];
  size: [number, number];
}

export interface Preset {
  name: string;
  title: string;
  summary: string;
  size: [number, number];
  time: number;
  scene: JsonObject;
}

/** Schemas of scene and quality, at `components/schemas`, and the names of the quality tiers. */
export interface SceneSchema extends JsonObject { tiers: string[]; }

export interface FrameRequest {
  scene: Json;
  quality: Json;
  camera: CameraState;
  time: number; // s
  width: number;
  height: number;
  preset: string | null; // Preset that the scene began from
  dither?: boolean; // Dithers 8 bits from 16; the server's default. The page's own pictures are rounded.
}

/** A frame of a stream. */
export type StreamView = Pick<FrameRequest, "camera" | "time" | "width" | "height">;

/** `lease`: time without a request after which it ends, s. */
interface OpenStream { id: string; lease: number; }

/** An option of a list. */
export interface Choice { name: string; title: string; }

/** Cost and error of one tier, as `make fronts` measured them. */
export interface TierCost {
  tier: string;
  fixed: number; // ms a frame at any size, on the measuring machine
  pixels: number; // ms a megapixel
  errors: readonly number[]; // RMSE at each of the scales, largest scale first, levels of 255
}

export interface TierCosts { scales: readonly number[]; presets: Readonly<Record<string, readonly TierCost[]>>; }

/** An error response of the server (RFC 9457), or no response. */
export class ApiError extends Error {
  override readonly name = "ApiError";

  constructor(
    message: string,
    /** 0 without a response. */
    readonly status: number,
    readonly details: readonly string[] = [],
    /** s after which to ask again; 0: not said. */
    readonly retryAfter = 0,
  ) {
    super(message);
  }
}

/** Status of a busy server and of one that was asked too often, and the number of attempts. */
const LATER = [429, 503];
const ATTEMPTS = 4;

export class Api {
  /** `base`: the server's address; the page's own by default. */
  constructor(private readonly base: string = document.baseURI) {}

  readonly presets = (): Promise<PresetSummary[]> => this.json("api/presets");

  readonly preset = (name: string): Promise<Preset> => this.json(`api/presets/${encodeURIComponent(name)}`);

  readonly schema = (): Promise<SceneSchema> => this.json("api/schema");

  /** A static file, written by `make fronts`. */
  readonly tierCosts = (): Promise<TierCosts> => this.json("fronts.json");

  /** A scene with the default of every absent field; rejects if it cannot be drawn. */
  readonly completeScene = (scene: JsonObject): Promise<JsonObject> => this.json("api/scenes", jsonPost(scene));

  plan(scene: Json, quality: Json, signal?: AbortSignal): Promise<FramePlan> {
    return this.json("api/plans", { ...jsonPost({ scene, quality }), ...(signal ? { signal } : {}) });
  }

  presetPlan(name: string, quality: string): Promise<FramePlan> {
    return this.json(`api/plans/${encodeURIComponent(name)}?quality=${encodeURIComponent(quality)}`);
  }

  /** Opens a stream of frames; rejects at once, with status 503, where all are taken. */
  readonly openStream = (scene: Json, quality: Json): Promise<OpenStream> => this.json("api/streams", jsonPost({ scene, quality }), 1);

  /** Shows another scene or quality; rejects with status 404 if the stream has ended. */
  async changeStream(id: string, scene: Json, quality: Json): Promise<void> {
    await this.fetch(`api/streams/${id}`, { ...jsonPost({ scene, quality }), method: "PUT" }, 1);
  }

  /** Also while the page is being left. */
  async closeStream(id: string): Promise<void> {
    await fetch(this.url(`api/streams/${id}`), { method: "DELETE", keepalive: true }).catch(() => undefined);
  }

  /** A frame of a stream; null if it was given up for later ones. */
  async streamFrame(id: string, { camera, time, width, height }: StreamView, signal: AbortSignal): Promise<Blob | null> {
    const [x, y, z] = camera.position;
    const { yaw, pitch, roll, fov } = camera;
    const query = Object.entries({ time, width, height, x, y, z, yaw, pitch, roll, fov }).map(([name, value]) => `${name}=${value}`);
    const response = await this.fetch(`api/streams/${id}/frame.jpg?${query.join("&")}`, { signal }, 1);
    return response.status === 204 ? null : response.blob();
  }

  /** A picture rendered by the server. */
  readonly frame = async (request: FrameRequest): Promise<Blob> => (await this.fetch("api/frames", jsonPost(request))).blob();

  /** A zip archive that draws a scene without a server. */
  readonly archive = async (request: FrameRequest): Promise<Blob> => (await this.fetch("api/export", jsonPost(request))).blob();

  /** A texture's bytes; the hash in the address makes them cacheable. */
  readonly texture = async ({ url, sha256 }: Texture, part?: "upper" | "lower"): Promise<ArrayBuffer> =>
    (await this.fetch(`${url}?sha256=${sha256}${part ? `&part=${part}` : ""}`)).arrayBuffer();

  /** Options that the server lists, such as the masks. The name precedes the title, which may be cut off. */
  async choices(url: string): Promise<Choice[]> {
    const list = await this.json<(Partial<Choice> & { name: string })[]>(url);
    return list.map(({ name, title }) => ({ name, title: title === undefined ? name : `${name} · ${title}` }));
  }

  private url(path: string): string {
    return new URL(path.replace(/^\//, ""), this.base).href;
  }

  private async json<T>(path: string, init?: RequestInit, attempts?: number): Promise<T> {
    return (await this.fetch(path, init, attempts)).json() as Promise<T>;
  }

  /** A successful response; retries while the server is busy or was asked too often, throws an `ApiError` otherwise. */
  async fetch(path: string, init?: RequestInit, attempts = ATTEMPTS): Promise<Response> {
    for (let attempt = 1; ; attempt++) {
      let response: Response;
      try {
        response = await fetch(this.url(path), init);
      } catch (error) {
        if (error instanceof DOMException && error.name === "AbortError") throw error;
        throw new ApiError("The server does not respond.", 0);
      }
      if (response.ok) return response;
      if (!LATER.includes(response.status) || attempt === attempts) throw await apiError(response);
      await new Promise((resolve) => setTimeout(resolve, 1000 * (Number(response.headers.get("Retry-After")) || attempt)));
    }
  }
}

const jsonPost = (body: object): RequestInit => ({ method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) });

/** The error of a problem+json response; of any other, the status. */
async function apiError(response: Response): Promise<ApiError> {
  // A proxy's error page is no JSON.
  const body = parsed(await response.text());
  const problem = isObject(body) ? body : {};
  const stringOf = (value: Json | undefined) => (typeof value === "string" ? value : undefined);
  const message = stringOf(problem["detail"]) ?? stringOf(problem["title"]) ?? `The server returned status ${response.status}.`;
  const errors = Array.isArray(problem["errors"]) ? problem["errors"] : [];
  const details = errors.filter(isObject).flatMap((e) => stringOf(e["detail"]) ?? []);
  // With a list of errors, `detail` would repeat them.
  return new ApiError(details.length > 0 ? (stringOf(problem["title"]) ?? message) : message, response.status, details, Number(response.headers.get("Retry-After")) || 0);
}

/** What went wrong, in words. */
export const messageOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));
