/** The filtered threshold where texels are larger than samples (docs/formulae.md, section 5, Magnified). */
import { type Mask, weights } from "./mask";

const END = 1 / 256; // Share of the plane over which coverage reaches exactly 0 and 1
const LEAST_HALF = 5e-4;

function smoothstep(low: number, high: number, x: number): number {
  const t = Math.min(Math.max((x - low) / (high - low), 0), 1);
  return t * t * (3 - 2 * t);
}

/** Q(s): the value below which the mask's B-spline is on a share s of the plane. */
function quantile(table: readonly number[], s: number): number {
  const share = Math.min(Math.max(s, 0), 1);
  const t = share <= 0.5 ? Math.sqrt(share / 2) : 1 - Math.sqrt((1 - share) / 2);
  const place = t * (table.length - 1);
  const i = Math.min(Math.floor(place), table.length - 2);
  const [low = 0, high = 1] = [table[i], table[i + 1]];
  return low + (place - i) * (high - low);
}

const slopes = (t: number) => [-((1 - t) ** 2) / 2, (3 * t ** 2 - 4 * t) / 2, (-3 * t ** 2 + 2 * t + 1) / 2, t ** 2 / 2];
const bends = (t: number) => [1 - t, 3 * t - 2, 1 - 3 * t, t];

/**
 * Mean of the mask's B-spline over a sample, and half the range of its values there. x, y: the sample's middle, texels;
 * side: its sides, texels, 1 at most.
 */
export function overSample({ size, values }: Mask, x: number, y: number, side: number): [mean: number, half: number] {
  const [column, row] = [Math.floor(x - 0.5), Math.floor(y - 0.5)];
  const [u, v] = [x - 0.5 - column, y - 0.5 - row];
  const across = [weights(u), slopes(u), bends(u)] as const;
  const down = [weights(v), slopes(v), bends(v)] as const;
  let [value, byX, byY, byXx, byYy] = [0, 0, 0, 0, 0];
  const last = size - 1;
  for (let j = 0; j < 4; j++) {
    const start = ((row - 1 + j) & last) * size;
    for (let i = 0; i < 4; i++) {
      const m = values[start + ((column - 1 + i) & last)] ?? 0;
      const [wx = 0, sx = 0, bx = 0] = [across[0][i], across[1][i], across[2][i]];
      const [wy = 0, sy = 0, by = 0] = [down[0][j], down[1][j], down[2][j]];
      value += wx * wy * m;
      byX += sx * wy * m;
      byY += wx * sy * m;
      byXx += bx * wy * m;
      byYy += wx * by * m;
    }
  }
  return [value + ((byXx + byYy) * side * side) / 24, Math.max(0.5 * side * Math.hypot(byX, byY), LEAST_HALF)];
}

/** Integral of the threshold's ramp of width `fade`. */
function ramp(x: number, fade: number): number {
  const rising = Math.min(Math.max(x, 0), fade);
  return (rising * rising) / Math.max(2 * fade, 1e-30) + Math.max(x - fade, 0);
}

/** What the coverage of all samples under one saturation has in common. */
interface Threshold {
  /** In values of the B-spline. */
  at: number;
  fade: number;
  /** Factors that make coverage exact at 0 and 1. */
  some: number;
  rest: number;
}

/** s in [0, 1]; fade: width of the ramp, as a share of the plane. */
export function thresholdOf(table: readonly number[], s: number, fade: number): Threshold {
  const at = quantile(table, s);
  const part = Math.min(s, fade);
  return {
    at,
    fade: ((at - quantile(table, s - part)) * fade) / Math.max(part, 1e-30),
    some: smoothstep(0, END, s),
    rest: fade === 0 ? smoothstep(0, END, 1 - s) : 1,
  };
}

/** Coverage of a sample, in [0, 1]; mean and half as from `overSample`. */
export function coverage({ at, fade, some, rest }: Threshold, mean: number, half: number): number {
  const covered = (some * (ramp(at - mean + half, fade) - ramp(at - mean - half, fade))) / (2 * half);
  return Math.min(Math.max(1 - (1 - covered) * rest, 0), 1);
}
