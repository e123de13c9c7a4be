/** Converts between a scene's numbers and a control's. */
import type { NumberControl } from "./model";

const DEGREES = 180 / Math.PI;

export function toDisplayed(control: NumberControl, value: number): number {
  return control.angle ? Number((value * DEGREES).toFixed(3)) : value;
}

/** Rounded to the control's step and clamped to the schema's range. */
export function fromDisplayed(control: NumberControl, value: number): number {
  const rounded = control.angle ? Number((value / DEGREES).toFixed(5)) : snap(value, control.step);
  return Math.min(control.max ?? Infinity, Math.max(control.min ?? -Infinity, rounded));
}

function snap(value: number, step: number | null): number {
  if (step === null) return value;
  const digits = Math.max(0, Math.ceil(-Math.log10(step)));
  return Number((Math.round(value / step) * step).toFixed(digits));
}

/** At most four significant digits. */
export function format(value: number): string {
  return String(Number(value.toPrecision(4)));
}
