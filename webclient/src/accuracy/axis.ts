/** Logarithmic axes. */

export interface Axis {
  /** Where a value stands, 0 to 1. */
  at(value: number): number;
  ticks: number[];
}

/** An axis that holds all of these values with some room around them; what is not positive stands at the low end. */
export function axis(values: readonly number[]): Axis {
  const positive = values.filter((value) => value > 0 && Number.isFinite(value));
  let low = Math.log10(Math.min(...positive));
  let high = Math.log10(Math.max(...positive));
  if (positive.length === 0) [low, high] = [0, 1];
  const room = Math.max(0.05 * (high - low), 0.5 * Math.max(0, 0.4 - (high - low)), 0.03);
  [low, high] = [low - room, high + room];
  const decades = high - low;
  const steps = decades > 3.2 ? [1] : decades > 1.1 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9];
  const ticks = [];
  for (let power = Math.floor(low); power <= high; power++) {
    for (const step of steps) {
      const at = Math.log10(step) + power;
      if (at >= low && at <= high) ticks.push(Number((step * 10 ** power).toPrecision(6)));
    }
  }
  return { at: (value) => (value > 0 ? Math.min(1, Math.max(0, (Math.log10(value) - low) / decades)) : 0), ticks };
}
