/** Spectrum and evenness of the pattern that a mask makes at a grey level (docs/masks.md). */
import { ringPower } from "../../charts/fourier";
import type { Mask } from "./mask";

/** Radially averaged power by frequency, cycles per texel, of the pattern of the `grey` N lowest thresholds of a mask; white noise is 1. */
export function spectrum({ size, values }: Mask, grey: number): [frequency: number, power: number][] {
  const count = size * size;
  const share = Math.round(grey * count) / count;
  const pattern = Float64Array.from(values, (value) => (value < share ? 1 - share : -share));
  const isMiddle = (k: number) => k === 0 || 2 * k === size;
  // Both of a conjugate pair count, and those that are their own twins twice: the mean over the half plane.
  const rings = ringPower(pattern, size, Math.round(size / Math.SQRT2), (x, y) => (isMiddle(x) && isMiddle(y) ? 2 : 1));
  return rings.map((power, i) => [(i + 1) / size, (power * count) / (share * (1 - share))]);
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
