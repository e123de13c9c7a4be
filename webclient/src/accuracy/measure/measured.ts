/** Measurements of qualities on one machine, their Pareto front, and their form as CSV and JSON. */
import type { JsonObject } from "../../scene/json";
import type { Point, Sweep } from "../api";
import type { BenchmarkResult, QualityResult } from "./benchmark";
import type { Errors, MetricKey } from "./errors";
import { type Cost, median, paretoFront, quantile } from "./statistics";

/** `time`: the median; `error`: RMSE. */
export interface Measured extends Cost {
  point: Point;
  /** Quartiles, ms. */
  low: number;
  high: number;
  /** ms; empty where only the model is known. */
  rounds: readonly number[];
  errors: Errors;
}

export interface Ranked extends Measured {
  /** Whether no other quality is both faster and more exact. */
  onFront: boolean;
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

export function rowsOf(measured: readonly Measured[], machine: string): Row[] {
  return ranked(measured, "rmse").map((one) => ({ ...one, machine }));
}

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
