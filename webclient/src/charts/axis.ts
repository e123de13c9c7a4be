/** Axes of charts. */

export interface Axis {
  logarithmic: boolean;
  low: number;
  high: number;
  position(value: number): number; // Position of a value, 0 to 1
  ticks: number[];
}

/** An axis over all the values, padded; values that are not positive have position 0. */
export function logAxis(values: readonly number[]): Axis {
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
  const position = (value: number) => (value > 0 ? Math.min(1, Math.max(0, (Math.log10(value) - low) / decades)) : 0);
  return { logarithmic: true, low: 10 ** low, high: 10 ** high, position, ticks };
}

/** An axis over all the values, with up to nine round ticks. */
export function linearAxis(values: readonly number[]): Axis {
  const finite = values.filter(Number.isFinite);
  const [least, greatest] = finite.length === 0 ? [0, 1] : [Math.min(...finite), Math.max(...finite)];
  const padding = 0.05 * (greatest - least) || 0.5;
  const [low, high] = [least - padding, greatest + padding];
  const power = 10 ** Math.floor(Math.log10((high - low) / 8));
  const step = power * ([1, 2, 5].find((factor) => (high - low) / (factor * power) <= 8) ?? 10);
  const first = Math.ceil(low / step);
  const ticks = Array.from({ length: Math.floor(high / step) - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(6)));
  return { logarithmic: false, low, high, position: (value) => Math.min(1, Math.max(0, (value - low) / (high - low))), ticks };
}

/** Ticks whose labels would lie closer than `spacing` px on an axis of `length` px are labelled with nothing. */
export function tickLabels(axis: Axis, length: number, spacing: number): string[] {
  let previous = -Infinity;
  return axis.ticks.map((tick) => {
    const at = length * axis.position(tick);
    if (at - previous < spacing) return "";
    previous = at;
    return tickLabel(tick);
  });
}

const POWERS = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** 0.001 to 5000 as they are, beyond as powers of ten. */
export function tickLabel(value: number): string {
  if (value <= 0) return String(value).replace("-", "−");
  if (value >= 0.001 && value < 10_000) return value >= 1000 ? `${value / 1000}k` : String(value);
  const power = Math.floor(Math.log10(value) + 1e-9);
  const digits = String(Math.abs(power)).replace(/\d/g, (digit) => POWERS.charAt(Number(digit)));
  const factor = Number((value / 10 ** power).toPrecision(2));
  return `${factor === 1 ? "" : `${factor}·`}10${power < 0 ? "⁻" : ""}${digits}`;
}
