/** The server's REST interface, as far as the page uses it. */
import type { Fronts } from "./app/front";
import type { FramePlan, Texture } from "./generated/api";
import { isObject, type Json, type JsonObject } from "./scene/json";

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

/** A name to choose, with how to show it. */
export interface Choice {
  name: string;
  title: string;
}

/** What went wrong, in the server's words (RFC 9457), or that it could not be reached at all. */
export class ApiError extends Error {
  override readonly name = "ApiError";

  constructor(
    message: string,
    /** 0 where no answer came. */
    readonly status: number,
    readonly details: readonly string[] = [],
  ) {
    super(message);
  }
}

/** The status of a server that is busy for the moment, and how often it is asked. */
const BUSY = 503;
const ATTEMPTS = 4;

export class Api {
  /** `base`: the server's address; the page's own by default. */
  constructor(private readonly base: string = document.baseURI) {}

  presets(): Promise<PresetSummary[]> {
    return this.json("api/presets");
  }

  preset(name: string): Promise<Preset> {
    return this.json(`api/presets/${encodeURIComponent(name)}`);
  }

  openapi(): Promise<JsonObject> {
    return this.json("openapi.json");
  }

  plan(scene: Json, quality: Json, signal?: AbortSignal): Promise<FramePlan> {
    return this.json("api/plans", { ...post({ scene, quality }), ...(signal ? { signal } : {}) });
  }

  presetPlan(name: string, quality: string): Promise<FramePlan> {
    return this.json(`api/plans/${encodeURIComponent(name)}?quality=${encodeURIComponent(quality)}`);
  }

  /** The server's own picture of a scene. */
  async frame(request: { scene: Json; quality: Json; time: number; width: number; height: number }): Promise<Blob> {
    return (await this.fetch("api/frames", post(request))).blob();
  }

  /** What was measured of every tier: a file of the page, see `make fronts`. */
  fronts(): Promise<Fronts> {
    return this.json("fronts.json");
  }

  /** The bytes of a plan's texture: with their hash in the address, so that browsers keep them. */
  async texture({ url, sha256 }: Texture): Promise<ArrayBuffer> {
    return (await this.fetch(`${url}?sha256=${sha256}`)).arrayBuffer();
  }

  /** A list of names, such as the mask catalogue. Titles may begin alike and be cut short: the name comes first. */
  async choices(url: string): Promise<Choice[]> {
    const list = await this.json<(Partial<Choice> & { name: string })[]>(url);
    return list.map(({ name, title }) => ({ name, title: title === undefined ? name : `${name} · ${title}` }));
  }

  /** An address below the server's, whether it is given from its root or relative. */
  private url(path: string): string {
    return new URL(path.replace(/^\//, ""), this.base).href;
  }

  private async json<T>(path: string, init?: RequestInit): Promise<T> {
    return (await this.fetch(path, init)).json() as Promise<T>;
  }

  /** An answer with a good status; waits for a busy server, throws an `ApiError` for any other. */
  async fetch(path: string, init?: RequestInit): Promise<Response> {
    for (let attempt = 1; ; attempt++) {
      let response: Response;
      try {
        response = await fetch(this.url(path), init);
      } catch (error) {
        if (error instanceof DOMException && error.name === "AbortError") throw error;
        throw new ApiError("The server does not answer.", 0);
      }
      if (response.ok) return response;
      if (response.status !== BUSY || attempt === ATTEMPTS) throw await problem(response);
      await new Promise((resolve) => setTimeout(resolve, 1000 * (Number(response.headers.get("Retry-After")) || attempt)));
    }
  }
}

function post(body: Json): RequestInit {
  return { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) };
}

/** Reads a problem+json answer; anything else is told by its status alone. */
async function problem(response: Response): Promise<ApiError> {
  const text = await response.text();
  let body: Json = null;
  try {
    body = JSON.parse(text) as Json;
  } catch {
    // Not JSON: a proxy's error page, perhaps.
  }
  const said = isObject(body) ? body : {};
  const words = (value: Json | undefined) => (typeof value === "string" ? value : undefined);
  const message = words(said["detail"]) ?? words(said["title"]) ?? `The server answered with status ${response.status}.`;
  const errors = Array.isArray(said["errors"]) ? said["errors"] : [];
  const details = errors.filter(isObject).flatMap((e) => words(e["detail"]) ?? []);
  // The server's detail is all errors in a row: said once is enough.
  return new ApiError(details.length > 0 ? (words(said["title"]) ?? message) : message, response.status, details);
}
