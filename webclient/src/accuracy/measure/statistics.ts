/** Statistics of measured times and errors: quantiles, Pareto front, comparison, time model; and such numbers as text. */
import type { Json } from "../../scene/json";

/** Linear between the two nearest values. */
export function quantile(values: readonly number[], share: number): number {
  const sorted = [...values].sort((a, b) => a - b);
  const index = share * (sorted.length - 1);
  const low = sorted[Math.floor(index)] ?? NaN;
  const high = sorted[Math.ceil(index)] ?? NaN;
  return low + (high - low) * (index - Math.floor(index));
}

export const median = (values: readonly number[]) => quantile(values, 0.5);

export interface Cost {
  id: string;
  /** ms */
  time: number;
  /** levels */
  error: number;
}

/** Points that no other beats in both time and error, fastest first. */
export function paretoFront<T extends Cost>(points: readonly T[]): T[] {
  let least = Infinity;
  return [...points]
    .sort((a, b) => a.time - b.time || a.error - b.error)
    .filter(({ error }) => {
      if (error >= least) return false;
      least = error;
      return true;
    });
}

interface Comparison {
  /** ms */
  added: number;
  /** Whether the quartiles of the rounds' time ratios lie on one side of 1. */
  measurable: boolean;
  summary: string;
}

/** Errors are shown to a thousandth of a level. */
const ERROR_RESOLUTION = 1e-3;
/** Error ratios closer to 1 count as equal. */
const EQUAL_RATIO = 1.02;

/** Compares two points by the times of interleaved rounds, ms, and by error, levels. */
export function compare(before: readonly number[], after: readonly number[], errorBefore: number, errorAfter: number): Comparison {
  const pairs = before.slice(0, after.length).map((time, i) => [time, after[i] ?? NaN] as const);
  const ratios = pairs.map(([a, b]) => b / a);
  const measurable = ratios.length > 1 && (quantile(ratios, 0.25) > 1 || quantile(ratios, 0.75) < 1);
  const time = measurable ? `${formatFactor(median(ratios))} the time` : "no measurable time difference";
  const gain = (errorBefore + ERROR_RESOLUTION) / (errorAfter + ERROR_RESOLUTION);
  let error = "same error";
  if (gain >= EQUAL_RATIO) error = `${formatFactor(gain)} less error`;
  else if (gain <= 1 / EQUAL_RATIO) error = `${formatFactor(1 / gain)} more error`;
  return { added: median(pairs.map(([a, b]) => b - a)), measurable, summary: `${time}, ${error}` };
}

/** time = fixed + perPixel · pixels, from two sizes. */
export function fitModel(largeTime: number, largePixels: number, smallTime: number, smallPixels: number): { fixed: number; perPixel: number } {
  if (largePixels === smallPixels) return { fixed: 0, perPixel: largeTime / largePixels };
  const perPixel = Math.max(0, (largeTime - smallTime) / (largePixels - smallPixels));
  return { fixed: Math.max(0, largeTime - perPixel * largePixels), perPixel };
}

/** ms or levels, to about three digits. */
export function formatNumber(value: number): string {
  const size = Math.abs(value);
  if (size === 0) return "0";
  return value.toFixed(size >= 99.5 ? 0 : size >= 9.95 ? 1 : size >= 0.0995 ? 2 : 3);
}

export function formatSigned(value: number): string {
  if (Math.abs(value) < 5e-4) return "0";
  return `${value < 0 ? "−" : "+"}${formatNumber(Math.abs(value))}`;
}

/** "4.3×"; close to 1 with one digit more. */
export function formatFactor(factor: number): string {
  return `${factor.toFixed(factor >= 9.95 ? 0 : factor >= 1.1 ? 1 : 2)}×`;
}

/** The value of a setting. */
export const valueText = (value: Json) => (typeof value === "string" ? value : JSON.stringify(value));
