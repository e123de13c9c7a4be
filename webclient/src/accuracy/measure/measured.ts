/** Measurements of qualities on one machine: statistics, Pareto front, comparison and time model; as text, CSV and JSON. */
import type { Json, JsonObject } from "../../scene/json";
import type { Point, Sweep } from "../api";
import type { Errors, MetricKey, Picture } from "./errors";

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
  time: number; // ms
  error: number; // levels
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
  added: number; // ms
  measurable: boolean; // Whether the quartiles of the rounds' time ratios lie on one side of 1
  summary: string;
}

const ERROR_RESOLUTION = 1e-3; // Errors are shown to a thousandth of a level
const EQUAL_RATIO = 1.02; // Error ratios closer to 1 count as equal

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
export const formatFactor = (factor: number): string => `${factor.toFixed(factor >= 9.95 ? 0 : factor >= 1.1 ? 1 : 2)}×`;

/** The value of a setting. */
export const valueText = (value: Json) => (typeof value === "string" ? value : JSON.stringify(value));

export type Size = [width: number, height: number];

export interface QualityResult {
  point: Point;
  errors: Errors;
  picture: Picture; // Linear light at the reference's size
  rounds: number[]; // ms of each round
  small: number[]; // The same at the small size
  /** Time of each pass, ms. */
  passes: { name: string; time: number }[];
}

export interface BenchmarkResult {
  measured: QualityResult[];
  /** Qualities that this GPU does not support. */
  unsupported: { point: Point; reason: string }[];
  sizes: { large: Size; small: Size };
  byGpu: boolean;
  rounds: number;
}

/** `time`: the median; `error`: RMSE. */
export interface Measured extends Cost {
  point: Point;
  /** Quartiles, ms. */
  low: number;
  high: number;
  rounds: readonly number[]; // ms; empty where only the model is known
  errors: Errors;
}

export interface Ranked extends Measured {
  onFront: boolean; // Whether no other quality is both faster and more exact
}

export function measuredHere({ point, rounds, errors }: Pick<QualityResult, "point" | "rounds" | "errors">): Measured {
  const [low, high] = [quantile(rounds, 0.25), quantile(rounds, 0.75)];
  return { id: point.id, point, rounds, errors, error: errors.rmse, time: median(rounds), low, high };
}

/** The server's points, with times predicted at the size that this machine timed. */
export function measuredThere({ points }: Sweep, { sizes: { large } }: BenchmarkResult): Measured[] {
  return points.map((point) => {
    const time = point.model.fixed_ms + 1e-6 * point.model.ns_per_pixel * large[0] * large[1];
    const scale = time / point.time.median_ms;
    const [low, high] = [scale * point.time.low_ms, scale * point.time.high_ms];
    return { id: point.id, point, rounds: [], errors: point.error, error: point.error.rmse, time, low, high };
  });
}

/** In the same order, with `error` by a measure. */
export function ranked(measured: readonly Measured[], metric: MetricKey): Ranked[] {
  const costs = measured.map((one) => ({ ...one, error: one.errors[metric] }));
  const front = new Set(paretoFront(costs));
  return costs.map((one) => ({ ...one, onFront: front.has(one) }));
}

/** One quality on one machine. */
type Row = Ranked & { machine: string };

export interface ExportedRun {
  preset: string;
  /** Timed size, pixels. */
  width: number;
  height: number;
  method: string;
  rows: readonly Row[];
}

export const rowsOf = (measured: readonly Measured[], machine: string): Row[] => ranked(measured, "rmse").map((one) => ({ ...one, machine }));

const HEADER = [
  ...["machine", "id", "label", "tier", "parameter", "value", "on_front"],
  ...["time_ms", "time_low_ms", "time_high_ms", "rounds_ms", "rmse", "flip", "max", "coverage"],
];

/** RFC 4180 with line feeds; rounds are separated by spaces. */
export function toCsv({ rows }: ExportedRun): string {
  const lines = rows.map(({ machine, point: { id, label, tier, parameter }, onFront, time, low, high, rounds, errors }) => [
    ...[machine, id, label, tier ?? "", parameter?.pointer ?? "", parameter ? JSON.stringify(parameter.value) : ""],
    ...[onFront ? "1" : "0", ...[time, low, high].map(digits), rounds.map(digits).join(" ")],
    ...[errors.rmse, errors.flip, errors.max, errors.coverage].map(digits),
  ]);
  return [HEADER, ...lines].map((cells) => `${cells.map(quoted).join(",")}\n`).join("");
}

export function toJson({ preset, width, height, method, rows }: ExportedRun): string {
  const points = rows.map(({ machine, point: { id, label, tier, parameter }, onFront, time, low, high, rounds, errors }): JsonObject => ({
    ...{ machine, id, label, tier, parameter: parameter?.pointer ?? null, value: parameter?.value ?? null, on_front: onFront },
    time: { median_ms: time, low_ms: low, high_ms: high, rounds_ms: [...rounds] },
    error: { ...errors },
  }));
  return `${JSON.stringify({ preset, timing: { width, height }, method, points }, null, 2)}\n`;
}

const digits = (value: number) => String(Number(value.toPrecision(6)));

const quoted = (cell: string) => (/[",\n]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell);
