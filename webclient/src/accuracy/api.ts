/** What the server says of the cost of accuracy, as far as the view uses it. */
import type { Api } from "../api";
import type { Json, JsonObject } from "../scene/json";

/** One knob's value; all others are as in the tier that everything is held against. */
export interface Knob {
  owner: string;
  pointer: string;
  title: string;
  cause: string;
  value: Json;
}

/** A quality that is measured. */
export interface Point {
  id: string;
  label: string;
  tier: string | null;
  knob: Knob | null;
  quality: JsonObject;
}

/** The converged float64 picture that errors are against. */
export interface TruthInfo {
  url: string | null;
  width: number;
  height: number;
  /** s */
  time: number;
  /** A pixel. */
  samples: number;
}

export interface Points {
  truth: TruthInfo;
  points: Point[];
}

/** The server's answer while it still computes. */
export interface Running {
  status: string;
  stage?: string;
  progress?: number;
  eta_s?: number | null;
}

/** What the server measured itself. */
export interface Sweep {
  machine: { renderer: string; processor?: string };
  points: (Point & {
    model: { fixed_ms: number; ns_per_pixel: number };
    error: { rmse: number; max: number; coverage: number };
  })[];
}

const path = (preset: string, rest = "") => `api/accuracy/${encodeURIComponent(preset)}${rest}`;

export async function pointsOf(api: Api, preset: string, signal: AbortSignal): Promise<Points> {
  return (await api.fetch(path(preset, "/points"), { signal })).json() as Promise<Points>;
}

export async function truthOf(
  api: Api,
  { url }: TruthInfo,
  preset: string,
  told: (running: Running) => void,
  signal: AbortSignal,
): Promise<ArrayBuffer> {
  return (await patiently(api, url ?? path(preset, "/truth.npy"), told, signal)).arrayBuffer();
}

export async function sweepOf(api: Api, preset: string, told: (running: Running) => void, signal: AbortSignal): Promise<Sweep> {
  return (await patiently(api, path(preset), told, signal)).json() as Promise<Sweep>;
}

/** Asks again for as long as the server says that it still computes. */
async function patiently(api: Api, url: string, told: (running: Running) => void, signal: AbortSignal): Promise<Response> {
  for (;;) {
    const response = await api.fetch(url, { signal });
    if (response.status !== 202) return response;
    told((await response.json()) as Running);
    await pause(1000 * (Number(response.headers.get("Retry-After")) || 2), signal);
  }
}

/** Waits; an abort ends the wait. */
export function pause(milliseconds: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    const aborted = () => {
      clearTimeout(timer);
      reject(signal.reason as Error);
    };
    if (signal.aborted) {
      reject(signal.reason as Error);
      return;
    }
    const timer = setTimeout(() => {
      signal.removeEventListener("abort", aborted);
      resolve();
    }, milliseconds);
    signal.addEventListener("abort", aborted, { once: true });
  });
}
