/** A mask to look at: shipped, or made from its parameters; its text in addresses, its data from the server, and its halftone patterns as pictures. */
import { signal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import { type Api, ApiError, messageOf } from "../api";

export const FAMILIES = ["vac", "blur", "clump", "bubble", "mix", "lace"] as const;
type Family = (typeof FAMILIES)[number];
export const SIDE_RANGE = [32, 1024] as const; // Of the width and of the height, texels

/** Least and greatest σ of any family, texels; the server says what a family and a size allow. */
export const SIGMA_RANGE = [0.5, 24] as const;
export const ASPECT_RANGE = [1, 6] as const;
export const SEED_RANGE = [0, 2 ** 32 - 1] as const;

export interface CustomMask {
  family: Family;
  /** Texels. */
  sigma: number;
  width: number;
  height: number;
  seed: number;
  /** Of lace: length of its cells along x over their width, and the age of its foam. */
  aspect: number;
  age: number;
}

/** The name of a shipped mask, or parameters. */
export type MaskChoice = string | CustomMask;

/** `family:sigma:size:seed`, for lace with `:aspect:age`, as in scenes; a size is a side or WIDTHxHEIGHT. */
export function choiceText(choice: MaskChoice): string {
  if (typeof choice === "string") return choice;
  const { family, sigma, width, height, seed, aspect, age } = choice;
  return [family, sigma, width === height ? width : `${width}x${height}`, seed, ...(family === "lace" ? [aspect, age] : [])].join(":");
}

/** Null for what is no mask. */
export function parseChoice(text: string): MaskChoice | null {
  if (/^[a-z][a-z\d.-]{0,39}$/.test(text)) return text;
  const [name, ...rest] = text.split(":");
  const family = FAMILIES.find((one) => one === name);
  const [sigma = NaN, , seed = NaN, aspect = 1, age = 0] = rest.map(Number);
  const [width = NaN, height = width] = (rest[1] ?? "").split("x").map(Number);
  const within = (value: number, [low, high]: readonly [number, number]) => value >= low && value <= high;
  const valid =
    family !== undefined &&
    rest.length === (family === "lace" ? 5 : 3) &&
    within(sigma, SIGMA_RANGE) &&
    [width, height, seed].every(Number.isInteger) &&
    within(width, SIDE_RANGE) &&
    within(height, SIDE_RANGE) &&
    within(seed, SEED_RANGE) &&
    within(aspect, ASPECT_RANGE) &&
    within(age, [0, 1]);
  return valid ? { family, sigma, width, height, seed, aspect, age } : null;
}

/** Path of a resource of the mask, below the server's address. */
export function maskPath(choice: MaskChoice, resource = ""): string {
  const rest = resource === "" ? "" : `/${resource}`;
  if (typeof choice === "string") return `api/masks/${encodeURIComponent(choice)}${rest}`;
  const { family, sigma, width, height, seed, aspect, age } = choice;
  const lace: Record<string, string> = family === "lace" ? { aspect: String(aspect), age: String(age) } : {};
  const query = new URLSearchParams({ family, sigma: String(sigma), width: String(width), height: String(height), seed: String(seed), ...lace });
  return `api/masks/custom${rest}?${query.toString()}`;
}

export interface LabState {
  left: MaskChoice;
  right: MaskChoice | null; // Null: one mask alone
  grey: number | null; // Saturation of the pattern; null: the mask itself
  show: Show;
}

/** One tile, two by two, or texels enlarged around the corner where four tiles meet. */
export const SHOWS = ["tile", "tiled", "detail"] as const;
export type Show = (typeof SHOWS)[number];

export const START: LabState = { left: "vac-24", right: null, grey: 0.25, show: "tile" };

export function encodeState({ left, right, grey, show }: LabState): string {
  const parts = { mask: choiceText(left), beside: right && choiceText(right), grey: grey ?? "mask", show: show === START.show ? null : show };
  return Object.entries(parts).flatMap(([key, value]) => (value === null ? [] : `${key}=${value}`)).join("&");
}

/** What is missing or wrong is as at the start. */
export function decodeState(fragment: string): LabState {
  const parts = new URLSearchParams(fragment.replace(/^#/, ""));
  const text = parts.get("grey");
  const grey = text === null || text === "" ? NaN : Number(text);
  const beside = parts.get("beside");
  return {
    left: parseChoice(parts.get("mask") ?? "") ?? START.left,
    right: beside === null ? null : parseChoice(beside),
    grey: text === "mask" ? null : grey >= 0 && grey <= 1 ? grey : START.grey,
    show: SHOWS.find((show) => show === parts.get("show")) ?? START.show,
  };
}

export interface Mask {
  /** Texels. */
  width: number;
  height: number;
  values: Uint16Array; // floor(rank 65536 / N), row by row
}

const DETAIL = 64; // Side of the enlarged part, texels

/** Whether foam shows in each texel: saturation above the threshold (v + 1/2) / 65536. */
export function threshold({ values }: Mask, saturation: number): Uint8Array {
  return Uint8Array.from(values, (value) => (saturation > (value + 0.5) / 65536 ? 1 : 0));
}

/** Share of foam, 0 to 1. */
export const coverage = (pattern: Uint8Array) => pattern.reduce((sum, foam) => sum + foam, 0) / pattern.length;

/** How much of one side of a mask a view shows, texels, and its first texel; masks repeat beyond their border. */
export function viewOf(side: number, show: Show): { shown: number; first: number } {
  if (show === "tiled") return { shown: 2 * side, first: 0 };
  const shown = Math.min(DETAIL, side);
  return show === "detail" ? { shown, first: side - Math.floor(shown / 2) } : { shown: side, first: 0 };
}

/** Grey of every pixel of a view, 0 to 255. `grey`: saturation of the pattern; null: the mask itself. */
export function shades(mask: Mask, grey: number | null, show: Show): Uint8ClampedArray {
  const [across, down] = [viewOf(mask.width, show), viewOf(mask.height, show)];
  const foam = grey === null ? null : threshold(mask, grey);
  return Uint8ClampedArray.from({ length: across.shown * down.shown }, (_, i) => {
    const [x, y] = [(across.first + (i % across.shown)) % mask.width, (down.first + Math.floor(i / across.shown)) % mask.height];
    const at = y * mask.width + x;
    return foam === null ? (mask.values[at] ?? 0) >> 8 : 255 * (foam[at] ?? 0);
  });
}

export interface MaskInfo {
  name: string;
  title: string;
  summary: string;
  family: string;
  parameters: { sigma: number; width: number; height: number; seed: number; aspect: number | null; age: number | null };
  sha256: string;
  license: string;
}

export interface Spectrum {
  frequency: number[]; // Cycles per texel
  bins: number[];
  greys: { grey: number; principal_frequency: number; raps: (number | null)[]; anisotropy_db: (number | null)[] }[];
}

export interface LoadedMask { info: MaskInfo; mask: Mask; spectrum: Spectrum; }

export interface MaskState {
  loaded: LoadedMask | null;
  busy: boolean;
  share: number | null; // Of a mask that the server makes in the background, what is done, 0 to 1
  error: string | null; // In words
}

const DELAY = 250; // Delay before a request, ms: a slider passes many values

/** Asks for a mask. `onProgress`: called with the share that is done of one that takes longer than a request may. */
export async function load(api: Api, choice: MaskChoice, abort: AbortSignal, onProgress: (share: number) => void): Promise<LoadedMask> {
  const get = (resource?: string) => api.fetch(maskPath(choice, resource), { signal: abort });
  // The first request makes the mask; the others find it in the server's cache.
  const first = await get().catch(async (refused: unknown) => {
    if (typeof choice === "string" || !(refused instanceof ApiError) || refused.status !== 422) throw refused;
    // What takes too long for a request is made in the background; what is refused there too is no mask.
    await follow(await get("events"), onProgress);
    return get();
  });
  const info = (await first.json()) as MaskInfo;
  const [values, spectrum] = await Promise.all([
    get("data.u16").then((response) => response.arrayBuffer()),
    get("spectrum").then((response) => response.json() as Promise<Spectrum>),
  ]);
  return { info, spectrum, mask: { width: info.parameters.width, height: info.parameters.height, values: new Uint16Array(values) } };
}

/** Reads the server-sent events of a mask that is made in the background, until it is there; throws if they end before. */
export async function follow(response: Response, onProgress: (share: number) => void): Promise<void> {
  if (response.body === null) throw new Error("The server sent no events.");
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) throw new Error("The server stopped making the mask.");
    const events = (text + value).split("\n\n");
    text = events.pop() ?? "";
    for (const event of events) {
      const [, name, data] = /^event: (\w+)\ndata: (.*)$/.exec(event) ?? [];
      if (name === "progress") onProgress(Number(data));
      if (name === "done") {
        await reader.cancel();
        return;
      }
    }
  }
}

/** The mask of a choice, null of none; the mask before it stays until it is here. */
export function useMask(api: Api, choice: MaskChoice | null): MaskState {
  const state = useMemo(() => signal<MaskState>({ loaded: null, busy: true, share: null, error: null }), []);
  const text = choice === null ? null : choiceText(choice);
  useEffect(() => {
    if (choice === null) return;
    const abort = new AbortController();
    const { loaded } = state.value;
    state.value = { ...state.value, busy: true, share: null };
    const onProgress = (share: number) => {
      state.value = { ...state.value, share };
    };
    const run = async () => {
      try {
        state.value = { loaded: await load(api, choice, abort.signal, onProgress), busy: false, share: null, error: null };
      } catch (error) {
        if (abort.signal.aborted) return;
        const details = error instanceof ApiError ? error.details : [];
        state.value = { ...state.value, busy: false, share: null, error: details.length > 0 ? details.join("; ") : messageOf(error) };
      }
    };
    const timer = setTimeout(() => void run(), loaded === null ? 0 : DELAY);
    return () => {
      clearTimeout(timer);
      abort.abort();
    };
    // The text stands for the choice.
  }, [api, text]);
  return state.value;
}
