/** Measurements of qualities on one machine, and their Pareto front. */
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
