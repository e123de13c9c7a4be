/** What the diagrams draw: the measured points on a chosen axis, for this machine and for the server. */
import type { Point, Sweep } from "../api";
import type { Row } from "../exportdata";
import { formatNumber } from "../format";
import type { BenchmarkResult, QualityResult } from "../measure/benchmark";
import type { Errors } from "../measure/errors";
import type { MetricKey } from "../measure/metrics";
import { type Cost, median, paretoFront, quantile } from "../measure/statistics";

/** A quality's measurement on one machine. */
export interface Measured {
  point: Point;
  /** Median and quartiles, ms. */
  time: number;
  low: number;
  high: number;
  rounds: readonly number[];
  errors: Errors;
}

export interface Mark extends Cost {
  label: string;
  /** Tiers are labelled in the diagram. */
  isTier: boolean;
  low: number;
  high: number;
  onFront: boolean;
}

export function measuredHere({ point, rounds, errors }: QualityResult): Measured {
  return { point, rounds, errors, time: median(rounds), low: quantile(rounds, 0.25), high: quantile(rounds, 0.75) };
}

/** The server's points, with times predicted at the size that this machine timed. */
export function measuredThere({ points }: Sweep, { sizes: { large } }: BenchmarkResult): Measured[] {
  return points.map((point) => {
    const time = point.model.fixed_ms + 1e-6 * point.model.ns_per_pixel * large[0] * large[1];
    const scale = time / point.time.median_ms;
    return { point, errors: point.error, time, low: scale * point.time.low_ms, high: scale * point.time.high_ms, rounds: [] };
  });
}

export function marksOf(measured: readonly Measured[], metric: MetricKey): Mark[] {
  const marks = measured.map(({ point, time, low, high, errors }) => ({
    ...{ id: point.id, label: point.label, isTier: point.tier !== null, time, low, high, error: errors[metric] },
  }));
  const front = new Set(paretoFront(marks).map(({ id }) => id));
  return marks.map((mark) => ({ ...mark, onFront: front.has(mark.id) })).sort((a, b) => a.time - b.time);
}

export function rowsOf(measured: readonly Measured[], machine: string): Row[] {
  const front = new Set(marksOf(measured, "rmse").flatMap(({ id, onFront }) => (onFront ? [id] : [])));
  return measured.map(({ point, ...rest }) => {
    const { id, label, tier, parameter } = point;
    return { machine, id, label, tier, parameter: parameter?.pointer ?? null, value: parameter?.value ?? null, onFront: front.has(id), ...rest };
  });
}

/** "1.2 ms, error 3.4". */
export function describe({ time, error }: Cost): string {
  return `${formatNumber(time)} ms, error ${formatNumber(error)}`;
}
