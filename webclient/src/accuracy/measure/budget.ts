/** The best quality for a time budget at the window's size. */
import { formatNumber } from "../format";
import type { BenchmarkResult } from "./benchmark";
import { type Cost, fitModel, median, paretoFront } from "./statistics";

/** A frame at 60 fps, ms. */
export const DEFAULT_BUDGET = 16;

type Predicted = Cost & { label: string };

/** Times at a size, by the model through the two timed sizes. */
export function predict({ measured, sizes: { large, small } }: BenchmarkResult, width: number, height: number): Predicted[] {
  return measured.map(({ point: { id, label }, rounds, small: smallRounds, errors }) => {
    const { fixed, perPixel } = fitModel(median(rounds), large[0] * large[1], median(smallRounds), small[0] * small[1]);
    return { id, label, error: errors.rmse, time: fixed + perPixel * width * height };
  });
}

export interface Choice {
  id: string;
  label: string;
  reason: string;
  /** Ids of the qualities within the budget. */
  fitting: ReadonlySet<string>;
}

export function choose(predicted: readonly Predicted[], budget: number, width: number, height: number): Choice | null {
  const fitting = predicted.filter(({ time }) => time <= budget);
  // The least error within the budget; if nothing is, the fastest of all.
  const point = fitting.length > 0 ? paretoFront(fitting).at(-1) : paretoFront(predicted)[0];
  if (point === undefined) return null;
  const reason =
    fitting.length > 0
      ? `least error of ${fitting.length} qualities within the budget (${predicted.length} measured)`
      : `fastest of ${predicted.length} qualities; none is within the budget`;
  const cost = `Predicted at ${width} × ${height}: ${formatNumber(point.time)} of ${formatNumber(budget)} ms a frame, RMSE ${formatNumber(point.error)} levels.`;
  return { id: point.id, label: point.label, fitting: new Set(fitting.map(({ id }) => id)), reason: `${reason}. ${cost}` };
}

/** Positions of the slider. */
export const SLIDER_STEPS = 200;

/** The slider's range, ms: a little beyond the fastest and the slowest. */
export function budgetRange(predicted: readonly Cost[]): [number, number] {
  const times = predicted.map(({ time }) => Math.max(time, 0.01));
  return times.length === 0 ? [1, 100] : [0.8 * Math.min(...times), 1.25 * Math.max(...times)];
}

/** Logarithmic, and rounded to what is shown. */
export function budgetAt(step: number, [low, high]: readonly [number, number]): number {
  return Number((low * (high / low) ** (step / SLIDER_STEPS)).toPrecision(3));
}

export function stepOf(budget: number, [low, high]: readonly [number, number]): number {
  const share = Math.log(budget / low) / Math.log(high / low);
  return Math.round(SLIDER_STEPS * Math.min(1, Math.max(0, share)));
}
