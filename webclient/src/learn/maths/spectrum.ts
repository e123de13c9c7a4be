/** Spectrum and evenness of the pattern that a mask makes at a grey level (docs/masks.md). */
import type { Mask } from "./mask";

export interface Spectrum {
  /** Cycles per texel; of ring i + 1. */
  frequency: Float64Array;
  /** Radially averaged power; white noise is 1. */
  raps: Float64Array;
}

interface Roots {
  cosines: Float64Array;
  sines: Float64Array;
}

const roots = new Map<number, Roots>();

/** The roots of unity e^(−2πik/count). */
function rootsOf(count: number): Roots {
  let found = roots.get(count);
  if (found === undefined) {
    const angles = Float64Array.from({ length: count / 2 }, (_, k) => (-2 * Math.PI * k) / count);
    found = { cosines: angles.map(Math.cos), sines: angles.map(Math.sin) };
    roots.set(count, found);
  }
  return found;
}

/** In-place transform of `count` complex numbers, `stride` apart from `start` (Cooley and Tukey, radix 2). */
function transform(re: Float64Array, im: Float64Array, start: number, stride: number, count: number): void {
  const swap = (a: Float64Array, i: number, j: number) => {
    const held = a[i] ?? 0;
    a[i] = a[j] ?? 0;
    a[j] = held;
  };
  for (let i = 1, j = 0; i < count; i++) {
    let bit = count >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i >= j) continue;
    swap(re, start + i * stride, start + j * stride);
    swap(im, start + i * stride, start + j * stride);
  }
  const { cosines, sines } = rootsOf(count);
  for (let length = 2; length <= count; length *= 2) {
    const half = length / 2;
    for (let base = 0; base < count; base += length) {
      for (let k = 0; k < half; k++) {
        const c = cosines[(k * count) / length] ?? 0;
        const s = sines[(k * count) / length] ?? 0;
        const a = start + (base + k) * stride;
        const b = a + half * stride;
        const x = re[b] ?? 0;
        const y = im[b] ?? 0;
        const tx = x * c - y * s;
        const ty = x * s + y * c;
        const ax = re[a] ?? 0;
        const ay = im[a] ?? 0;
        re[b] = ax - tx;
        im[b] = ay - ty;
        re[a] = ax + tx;
        im[a] = ay + ty;
      }
    }
  }
}

/** Spectrum of the pattern of the `grey` N lowest thresholds of a mask. */
export function spectrum({ size, values }: Mask, grey: number): Spectrum {
  const count = size * size;
  const share = Math.round(grey * count) / count;
  const re = Float64Array.from(values, (value) => (value < share ? 1 - share : -share));
  const im = new Float64Array(count);
  for (let row = 0; row < size; row++) transform(re, im, row * size, 1, size);
  for (let column = 0; column < size; column++) transform(re, im, column, size, size);
  const rings = Math.round(Math.hypot(size / 2, size / 2));
  const [power, bins] = [new Float64Array(rings), new Float64Array(rings)];
  for (let y = 0; y < size; y++) {
    const ky = y <= size / 2 ? y : y - size;
    for (let x = 0; x < size; x++) {
      const ring = Math.round(Math.hypot(x <= size / 2 ? x : x - size, ky));
      if (ring === 0) continue;
      const i = y * size + x;
      // Both of a conjugate pair count, and those that are their own twins twice: the mean over the half plane.
      const twice = (x === 0 || 2 * x === size) && (y === 0 || 2 * y === size) ? 2 : 1;
      power[ring - 1] = (power[ring - 1] ?? 0) + twice * ((re[i] ?? 0) ** 2 + (im[i] ?? 0) ** 2);
      bins[ring - 1] = (bins[ring - 1] ?? 0) + twice;
    }
  }
  const scale = 1 / (count * share * (1 - share));
  return {
    frequency: Float64Array.from(power, (_, i) => (i + 1) / size),
    raps: power.map((sum, i) => (scale * sum) / (bins[i] ?? 1)),
  };
}

/** Standard deviation of the coverage of boxes of `box` by `box` texels, under one saturation. */
export function unevenness({ size, values }: Mask, grey: number, box: number): number {
  const boxes = size / box;
  const covered = new Float64Array(boxes * boxes);
  values.forEach((value, i) => {
    if (value >= grey) return;
    const at = Math.floor(i / size / box) * boxes + Math.floor((i % size) / box);
    covered[at] = (covered[at] ?? 0) + 1 / (box * box);
  });
  const mean = covered.reduce((sum, one) => sum + one, 0) / covered.length;
  return Math.sqrt(covered.reduce((sum, one) => sum + (one - mean) ** 2, 0) / covered.length);
}
