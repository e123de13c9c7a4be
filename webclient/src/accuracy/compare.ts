/** What measured numbers say: middle and spread, the front, what buys what, and what fits a budget. */

/** A quantile of numbers, between the two nearest where it falls between. */
export function quantile(values: readonly number[], share: number): number {
  const sorted = [...values].sort((a, b) => a - b);
  const at = share * (sorted.length - 1);
  const low = sorted[Math.floor(at)] ?? NaN;
  const high = sorted[Math.ceil(at)] ?? NaN;
  return low + (high - low) * (at - Math.floor(at));
}

export const median = (values: readonly number[]) => quantile(values, 0.5);

export interface Cost {
  id: string;
  /** ms */
  time: number;
  /** levels */
  error: number;
}

/** What nothing else beats in both time and error, from the fastest. */
export function front<T extends Cost>(points: readonly T[]): T[] {
  let least = Infinity;
  return [...points]
    .sort((a, b) => a.time - b.time || a.error - b.error)
    .filter(({ error }) => {
      if (error >= least) return false;
      least = error;
      return true;
    });
}

export interface Comparison {
  added: number;
  /** Of times. */
  factor: number;
  /** Whether the quartiles of the rounds' ratios lie on one side of 1. */
  measurable: boolean;
  words: string;
}

/** Errors are quoted to a thousandth of a level; less is no error at all. */
const NO_ERROR = 1e-3;
/** A ratio of errors nearer to 1 than this is no difference. */
const SAME = 1.02;

/** A point that costs `after` against one that costs `before`, rounds of which were drawn in turn. */
export function compare(
  before: readonly number[],
  after: readonly number[],
  errorBefore: number,
  errorAfter: number,
): Comparison {
  const pairs = before.slice(0, after.length).map((time, i) => [time, after[i] ?? NaN] as const);
  const ratios = pairs.map(([a, b]) => b / a);
  const measurable = ratios.length > 1 && (quantile(ratios, 0.25) > 1 || quantile(ratios, 0.75) < 1);
  const factor = median(ratios);
  const gain = (errorBefore + NO_ERROR) / (errorAfter + NO_ERROR);
  const time = measurable ? `${times(factor)} the time` : "no measurable difference in time";
  const dearer = measurable && factor > 1;
  let words: string;
  if (gain >= SAME) words = `${time} ${dearer ? "buys" : "and"} ${times(gain)} less error`;
  else if (gain <= 1 / SAME) words = `${time} and ${times(1 / gain)} more error`;
  else words = dearer ? `${time} buys nothing` : `${time}, the same error`;
  return { added: median(pairs.map(([a, b]) => b - a)), factor, measurable, words };
}

/** "4.3×"; close to 1 with a digit more. */
export function times(factor: number): string {
  return `${factor.toFixed(factor >= 9.95 ? 0 : factor >= 1.1 ? 1 : 2)}×`;
}

export interface Model {
  fixed: number;
  perPixel: number;
}

/** time = fixed + perPixel · pixels, from two sizes. */
export function model(large: number, pixels: number, small: number, few: number): Model {
  if (pixels === few) return { fixed: 0, perPixel: large / pixels };
  const perPixel = Math.max(0, (large - small) / (pixels - few));
  return { fixed: Math.max(0, large - perPixel * pixels), perPixel };
}

export interface Pick<T> {
  point: T;
  fits: boolean;
  /** How many fit. */
  fitting: number;
}

/** The least error that fits the time; where nothing fits, the fastest. */
export function pick<T extends Cost>(points: readonly T[], budget: number): Pick<T> | null {
  const fitting = points.filter(({ time }) => time <= budget);
  const best = fitting.length > 0 ? front(fitting).at(-1) : front(points)[0];
  return best === undefined ? null : { point: best, fits: fitting.length > 0, fitting: fitting.length };
}

/** A number of ms or levels, short. */
export function short(value: number): string {
  const size = Math.abs(value);
  if (size === 0) return "0";
  return value.toFixed(size >= 99.5 ? 0 : size >= 9.95 ? 1 : size >= 0.0995 ? 2 : 3);
}
