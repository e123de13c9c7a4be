/** Logarithmic axes. */

export interface LogAxis {
  /** Position of a value, 0 to 1. */
  position(value: number): number;
  ticks: number[];
}

/** An axis over all the values, padded; values that are not positive have position 0. */
export function logAxis(values: readonly number[]): LogAxis {
  const positive = values.filter((value) => value > 0 && Number.isFinite(value));
  let low = Math.log10(Math.min(...positive));
  let high = Math.log10(Math.max(...positive));
  if (positive.length === 0) [low, high] = [0, 1];
  const padding = Math.max(0.05 * (high - low), 0.5 * Math.max(0, 0.4 - (high - low)), 0.03);
  [low, high] = [low - padding, high + padding];
  const decades = high - low;
  const steps = decades > 3.2 ? [1] : decades > 1.1 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9];
  const ticks = [];
  for (let power = Math.floor(low); power <= high; power++) {
    for (const step of steps) {
      const exponent = Math.log10(step) + power;
      if (exponent >= low && exponent <= high) ticks.push(Number((step * 10 ** power).toPrecision(6)));
    }
  }
  return { position: (value) => (value > 0 ? Math.min(1, Math.max(0, (Math.log10(value) - low) / decades)) : 0), ticks };
}
