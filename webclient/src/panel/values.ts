/** Between a scene's numbers and what a control shows. */
import type { NumberControl } from "./model";

const DEGREES = 180 / Math.PI;

export function toDisplayed(control: NumberControl, value: number): number {
  return control.angle ? Number((value * DEGREES).toFixed(3)) : value;
}

/** The scene's number: rounded to what the control can be set to, and never outside the schema's range. */
export function fromDisplayed(control: NumberControl, value: number): number {
  const rounded = control.angle ? Number((value / DEGREES).toFixed(5)) : snap(value, control.step);
  return Math.min(control.max ?? Infinity, Math.max(control.min ?? -Infinity, rounded));
}

function snap(value: number, step: number | null): number {
  if (step === null) return value;
  const digits = Math.max(0, Math.ceil(-Math.log10(step)));
  return Number((Math.round(value / step) * step).toFixed(digits));
}

/** At most four digits that mean something. */
export function format(value: number): string {
  return String(Number(value.toPrecision(4)));
}
