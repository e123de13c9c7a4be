/** A mask's data and measurements from the server. */
import { signal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import { type Api, ApiError, messageOf } from "../api";
import { choiceText, type MaskChoice, maskPath } from "./choice";
import type { Mask } from "./pattern";

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
  isotropic_reference_db: number;
  /** Cycles per texel. */
  frequency: number[];
  bins: number[];
  greys: { grey: number; principal_frequency: number; raps: (number | null)[]; anisotropy_db: (number | null)[] }[];
}

export interface LoadedMask { info: MaskInfo; mask: Mask; spectrum: Spectrum; }

export interface MaskState {
  loaded: LoadedMask | null;
  busy: boolean;
  /** Of a mask that the server makes in the background, what is done, 0 to 1. */
  share: number | null;
  /** In words. */
  error: string | null;
}

/** Delay before a request, ms: a slider passes many values. */
const DELAY = 250;

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
