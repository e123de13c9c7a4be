/** The best quality for a time budget at the window's size, and the benefit of each quality setting. */
import { get } from "../../scene/json";
import { type BenchmarkResult, compare, type Cost, fitModel, formatNumber, type Measured, median, paretoFront, valueText } from "./measured";

export const DEFAULT_BUDGET = 16; // A frame at 60 fps, ms

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
  fitting: ReadonlySet<string>; // Ids of the qualities within the budget
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

export const SLIDER_STEPS = 200; // Positions of the slider

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

export const NEGLIGIBLE = 0.01; // Less error than this counts as none, levels

export interface Benefit {
  owner: string;
  title: string;
  cause: string;
  /** From the cheaper value to the dearer; without a measurable time difference, from the worse to the better. */
  from: string;
  to: string;
  id: string; // Id of the point that is not the standard
  added: number; // ms
  measurable: boolean;
  removed: number; // Levels
  perMs: number | null; // Levels per ms; null if no measurable time is added
}

/** Sorted by benefit: error removed at no cost first. */
export function benefits(standard: Measured, points: readonly Measured[]): Benefit[] {
  const list = points.flatMap((changed): Benefit[] => {
    const { parameter } = changed.point;
    if (parameter === null || changed.rounds.length === 0) return [];
    const comparison = compare(standard.rounds, changed.rounds, 0, 0);
    const ascending = comparison.measurable ? comparison.added >= 0 : changed.error <= standard.error;
    const [first, second] = ascending ? [standard, changed] : [changed, standard];
    const { added, measurable } = compare(first.rounds, second.rounds, 0, 0);
    const removed = first.error - second.error;
    const value = (timed: Measured) => valueText(timed === standard ? (get(standard.point.quality, parameter.pointer) ?? null) : parameter.value);
    const perMs = measurable && added > 0 ? removed / added : null;
    const { owner, title, cause } = parameter;
    return [{ owner, title, cause, from: value(first), to: value(second), id: changed.id, added, measurable, removed, perMs }];
  });
  const rank = ({ perMs, removed }: Benefit) => perMs ?? (removed < NEGLIGIBLE ? 0 : Infinity);
  return list.sort((a, b) => {
    const [rankA, rankB] = [rank(a), rank(b)];
    return rankA === rankB ? b.removed - a.removed : rankB - rankA;
  });
}
