/** The server's accuracy endpoints, as far as the benchmark uses them. */
import type { Api } from "../api";
import type { Json, JsonObject } from "../scene/json";
import type { Errors } from "./measure/errors";

/** One quality setting with its value; all others are those of the standard tier. */
interface QualityParameter { owner: string; pointer: string; title: string; cause: string; value: Json; }

/** A quality to measure. */
export interface Point {
  id: string;
  label: string;
  tier: string | null;
  parameter: QualityParameter | null;
  quality: JsonObject;
}

/** The converged float64 reference. */
export interface TruthInfo {
  url: string | null;
  width: number;
  height: number;
  time: number; // s
  samples: number; // Per pixel
}

/** The server's answer while it computes. */
export interface JobProgress { status: string; stage?: string; progress?: number; eta_s?: number | null; }

/** The server's own measurement. */
export interface Sweep {
  machine: { renderer: string; processor?: string };
  points: (Point & {
    /** At the preset's own size. */
    time: { median_ms: number; low_ms: number; high_ms: number };
    model: { fixed_ms: number; ns_per_pixel: number };
    error: Errors;
  })[];
}

type Report = (progress: JobProgress) => void;

const path = (preset: string, rest = "") => `api/accuracy/${encodeURIComponent(preset)}${rest}`;

export async function fetchPoints(api: Api, preset: string, signal: AbortSignal): Promise<{ truth: TruthInfo; points: Point[] }> {
  return (await api.fetch(path(preset, "/points"), { signal })).json() as ReturnType<typeof fetchPoints>;
}

export async function fetchTruth(api: Api, { url }: TruthInfo, preset: string, onProgress: Report, signal: AbortSignal): Promise<ArrayBuffer> {
  return (await fetchWhenReady(api, url ?? path(preset, "/truth.npy"), onProgress, signal)).arrayBuffer();
}

export async function fetchSweep(api: Api, preset: string, onProgress: Report, signal: AbortSignal): Promise<Sweep> {
  return (await fetchWhenReady(api, path(preset), onProgress, signal)).json() as Promise<Sweep>;
}

/** Repeats the request while the server computes (status 202). */
async function fetchWhenReady(api: Api, url: string, onProgress: Report, signal: AbortSignal): Promise<Response> {
  for (;;) {
    const response = await api.fetch(url, { signal });
    if (response.status !== 202) return response;
    onProgress((await response.json()) as JobProgress);
    await delay(1000 * (Number(response.headers.get("Retry-After")) || 2), signal);
  }
}

/** Waits; rejects on abort. */
function delay(milliseconds: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    signal.throwIfAborted();
    setTimeout(resolve, milliseconds);
    signal.addEventListener("abort", () => reject(signal.reason as Error), { once: true });
  });
}
