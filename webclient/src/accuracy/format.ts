/** Numbers and settings as text. */
import type { Json } from "../scene/json";

/** ms or levels, to about three digits. */
export function formatNumber(value: number): string {
  const size = Math.abs(value);
  if (size === 0) return "0";
  return value.toFixed(size >= 99.5 ? 0 : size >= 9.95 ? 1 : size >= 0.0995 ? 2 : 3);
}

export function formatSigned(value: number): string {
  if (Math.abs(value) < 5e-4) return "0";
  return `${value < 0 ? "−" : "+"}${formatNumber(Math.abs(value))}`;
}

/** "4.3×"; close to 1 with one digit more. */
export function formatFactor(factor: number): string {
  return `${factor.toFixed(factor >= 9.95 ? 0 : factor >= 1.1 ? 1 : 2)}×`;
}

/** The value of a setting. */
export const valueText = (value: Json) => (typeof value === "string" ? value : JSON.stringify(value));
