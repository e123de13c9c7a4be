/** Halftone masks and the foam texture: the server's bytes, and white noise. */
import { effect, type Signal, signal } from "@preact/signals";
import type { Api } from "../../api";

export interface Mask {
  name: string;
  title: string;
  size: number; // Side, texels; a power of two
  values: Float32Array; // Thresholds (rank + ½)/N, row by row
  readonly quantiles: readonly number[]; // Quantiles of the mask's B-spline
}

export const WHITE = "white";
const SIZE = 512; // Side of shipped masks, texels
const WHITE_SEED = 2011;
const ENTRIES = 65;

const known = new Map<string, Promise<Mask>>();

/** A shipped mask, or white noise; the same promise for the same name. */
export function loadMask(api: Api, name: string): Promise<Mask> {
  let mask = known.get(name);
  if (mask === undefined) {
    mask = name === WHITE ? Promise.resolve().then(() => whiteNoise(SIZE, WHITE_SEED)) : fetchMask(api, name);
    known.set(name, mask);
    // A failed request may succeed later.
    mask.catch(() => known.delete(name));
  }
  return mask;
}

/** The mask that a control names; the last one while it loads, or if it cannot be loaded. */
export async function followedMask(api: Api, name: Signal<string>): Promise<Signal<Mask>> {
  const mask = signal(await loadMask(api, name.peek()));
  effect(() => {
    const asked = name.value;
    loadMask(api, asked).then(
      (loaded) => {
        if (name.peek() === asked) mask.value = loaded;
      },
      () => (name.value = mask.peek().name),
    );
  });
  return mask;
}

/** Names and titles of the shipped masks, and of white noise. */
export async function maskOptions(api: Api): Promise<readonly (readonly [string, string])[]> {
  const masks = await api.choices("api/masks");
  return [[WHITE, "white noise"], ...masks.map(({ name, title }) => [name, title] as const)];
}

async function fetchMask(api: Api, name: string): Promise<Mask> {
  const path = `api/masks/${encodeURIComponent(name)}`;
  const [data, sidecar] = await Promise.all([
    api.fetch(`${path}/data.u16`).then((response) => response.arrayBuffer()),
    api.fetch(`${path}/sidecar`).then((response) => response.json() as Promise<{ title: string; quantile: { entries: number[] } }>),
  ]);
  const words = new Uint16Array(data);
  return { name, title: sidecar.title, size: Math.sqrt(words.length), values: thresholds(words), quantiles: sidecar.quantile.entries };
}

/** Thresholds of 16-bit values: the middle of the interval that each stands for. */
export const thresholds = (words: Uint16Array): Float32Array => Float32Array.from(words, (word) => (word + 0.5) / 65536);

/** PCG-RXS-M-XS 32 (O'Neill 2014), as in the shaders. */
function pcg(word: number): number {
  const state = (Math.imul(word, 747796405) + 2891336453) >>> 0;
  const mixed = Math.imul((state >>> ((state >>> 28) + 4)) ^ state, 277803737) >>> 0;
  return ((mixed >>> 22) ^ mixed) >>> 0;
}

/** The ranks 0 … N − 1 in random order (Fisher and Yates): every threshold once, at places that know nothing of one another. */
export function shuffledRanks(count: number, seed: number): Uint32Array {
  const ranks = Uint32Array.from({ length: count }, (_, i) => i);
  for (let i = count - 1; i > 0; i--) {
    const j = Math.floor((pcg((seed + i) >>> 0) / 2 ** 32) * (i + 1));
    const [a = 0, b = 0] = [ranks[i], ranks[j]];
    ranks[i] = b;
    ranks[j] = a;
  }
  return ranks;
}

function whiteNoise(size: number, seed: number): Mask {
  const count = size * size;
  const values = Float32Array.from(shuffledRanks(count, seed), (rank) => (rank + 0.5) / count);
  let table: readonly number[] | null = null;
  return {
    name: WHITE,
    title: "White noise",
    size,
    values,
    // A tenth of a second's work, which only the filtered look needs.
    get quantiles() {
      table ??= quantileTable(values, size);
      return table;
    },
  };
}

/** Weights of the cubic B-spline of four values, at a share t of the way from the second to the third. */
export const weights = (t: number) => [(1 - t) ** 3 / 6, (3 * t ** 3 - 6 * t ** 2 + 4) / 6, (-3 * t ** 3 + 3 * t ** 2 + 3 * t + 1) / 6, t ** 3 / 6];

/** The B-spline at two places in each texel of rows of `size`, a quarter beside its middle; rows and columns change places. */
function doubled(values: Float32Array, size: number): Float32Array {
  const rows = values.length / size;
  // Read backwards they are those a quarter before the next texel's middle.
  const past = weights(0.25);
  const result = new Float32Array(2 * values.length);
  for (let i = 0; i < values.length; i++) {
    const [x, y] = [i % size, Math.floor(i / size)];
    let [near, far] = [0, 0];
    for (let tap = 0; tap < 4; tap++) {
      const m = values[y * size + ((x + tap - 1) & (size - 1))] ?? 0;
      near += (past[tap] ?? 0) * m;
      far += (past[3 - tap] ?? 0) * m;
    }
    result[2 * x * rows + y] = near;
    result[(2 * x + 1) * rows + y] = far;
  }
  return result;
}

/** Quantiles of the B-spline, from its values at two by two places in each texel. */
function quantileTable(values: Float32Array, size: number): number[] {
  const samples = doubled(doubled(values, size), size);
  samples.sort();
  return Array.from({ length: ENTRIES }, (_, i) => {
    const t = i / (ENTRIES - 1);
    const share = t <= 0.5 ? 2 * t * t : 1 - 2 * (1 - t) ** 2;
    return samples[Math.round(share * (samples.length - 1))] ?? 0;
  });
}

const SIDE = 256; // Side of its finest level, texels
const TILE = (512 * 2.4) / 9; // Its side in texels of the mask, as in the scene of figure 7 (tiles of 2.4 m and 9 m)

let loading: Promise<Uint8Array> | null = null;

export function loadFoamTexture(api: Api): Promise<Uint8Array> {
  loading ??= api.fetch("api/textures/foam").then(async (response) => new Uint8Array(await response.arrayBuffer(), 0, SIDE * SIDE));
  loading.catch(() => (loading = null));
  return loading;
}

/** t at the middle of each texel of a part of the mask, row by row. */
export function foamTextures(texture: Uint8Array, columns: number, rows: number): Float32Array<ArrayBuffer> {
  return Float32Array.from({ length: columns * rows }, (_, i) => foamTexture(texture, (i % columns) + 0.5, Math.floor(i / columns) + 0.5));
}

/** t at a place of the mask, texels; bilinear. */
function foamTexture(texture: Uint8Array, x: number, y: number): number {
  const [u, v] = [(x / TILE) * SIDE - 0.5, (y / TILE) * SIDE - 0.5];
  const [i, j] = [Math.floor(u), Math.floor(v)];
  const at = (column: number, row: number) => (texture[(row & (SIDE - 1)) * SIDE + (column & (SIDE - 1))] ?? 0) / 255;
  const along = (row: number) => at(i, row) + (u - i) * (at(i + 1, row) - at(i, row));
  return along(j) + (v - j) * (along(j + 1) - along(j));
}
