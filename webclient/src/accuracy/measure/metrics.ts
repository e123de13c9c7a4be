/** The measures of error that the diagrams can show. */
import type { Errors } from "./errors";

interface Metric {
  key: keyof Errors;
  label: string;
  /** For the axis. */
  unit: string;
}

export const METRICS = [
  { key: "rmse", label: "RMSE", unit: "levels of 255" },
  { key: "flip", label: "FLIP", unit: "0 to 1" },
  { key: "max", label: "maximum", unit: "levels of 255" },
  { key: "coverage", label: "foam coverage", unit: "RMSE, 0 to 1" },
] as const satisfies readonly Metric[];

export type MetricKey = (typeof METRICS)[number]["key"];

export function metricOf(key: MetricKey): Metric {
  return METRICS.find((metric) => metric.key === key) ?? METRICS[0];
}
