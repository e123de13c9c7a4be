/** Halftone masks: the server's bytes, and white noise. */
import type { Api } from "../../api";

export interface Mask {
  name: string;
  title: string;
  /** Side, texels; a power of two. */
  size: number;
  /** Thresholds (rank + ½)/N, row by row. */
  values: Float32Array;
  /** Quantiles of the mask's B-spline. */
  readonly quantiles: readonly number[];
}

export const WHITE = "white";
/** Side of shipped masks, texels. */
const SIZE = 512;
const WHITE_SEED = 2011;
const ENTRIES = 65;

const loaded = new Map<string, Promise<Mask>>();

/** A shipped mask, or white noise; the same promise for the same name. */
export function loadMask(api: Api, name: string): Promise<Mask> {
  let mask = loaded.get(name);
  if (mask === undefined) {
    mask = name === WHITE ? Promise.resolve().then(() => whiteNoise(SIZE, WHITE_SEED)) : fetchMask(api, name);
    loaded.set(name, mask);
    // A failed request may succeed later.
    mask.catch(() => loaded.delete(name));
  }
  return mask;
}

interface Sidecar {
  title: string;
  quantile: { entries: number[] };
}

async function fetchMask(api: Api, name: string): Promise<Mask> {
  const path = `api/masks/${encodeURIComponent(name)}`;
  const [data, sidecar] = await Promise.all([
    api.fetch(`${path}/data.u16`).then((response) => response.arrayBuffer()),
    api.fetch(`${path}/sidecar`).then((response) => response.json() as Promise<Sidecar>),
  ]);
  const words = new Uint16Array(data);
  return { name, title: sidecar.title, size: Math.sqrt(words.length), values: thresholds(words), quantiles: sidecar.quantile.entries };
}

/** Thresholds of 16-bit values: the middle of the interval that each stands for. */
export function thresholds(words: Uint16Array): Float32Array {
  return Float32Array.from(words, (word) => (word + 0.5) / 65536);
}

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

/** Quantiles of the B-spline, from its values at two by two places in each texel. */
function quantileTable(values: Float32Array, size: number): number[] {
  // Weights a quarter texel past a texel's middle; read backwards they are those a quarter before the next.
  const weights = [0.75 ** 3 / 6, (3 * 0.25 ** 3 - 6 * 0.25 ** 2 + 4) / 6, (-3 * 0.25 ** 3 + 3 * 0.25 ** 2 + 1.75) / 6, 0.25 ** 3 / 6];
  const last = size - 1;
  const rows = new Float32Array(2 * size * size);
  for (let y = 0; y < size; y++) {
    for (let x = 0; x < size; x++) {
      let [near, far] = [0, 0];
      for (let tap = 0; tap < 4; tap++) {
        const m = values[y * size + ((x + tap - 1) & last)] ?? 0;
        near += (weights[tap] ?? 0) * m;
        far += (weights[3 - tap] ?? 0) * m;
      }
      rows[y * 2 * size + 2 * x] = near;
      rows[y * 2 * size + 2 * x + 1] = far;
    }
  }
  const samples = new Float32Array(4 * size * size);
  for (let y = 0; y < size; y++) {
    for (let x = 0; x < 2 * size; x++) {
      let [near, far] = [0, 0];
      for (let tap = 0; tap < 4; tap++) {
        const m = rows[((y + tap - 1) & last) * 2 * size + x] ?? 0;
        near += (weights[tap] ?? 0) * m;
        far += (weights[3 - tap] ?? 0) * m;
      }
      samples[(2 * y * size + x) * 2] = near;
      samples[(2 * y * size + x) * 2 + 1] = far;
    }
  }
  samples.sort();
  return Array.from({ length: ENTRIES }, (_, i) => {
    const t = i / (ENTRIES - 1);
    const share = t <= 0.5 ? 2 * t * t : 1 - 2 * (1 - t) ** 2;
    return samples[Math.round(share * (samples.length - 1))] ?? 0;
  });
}
