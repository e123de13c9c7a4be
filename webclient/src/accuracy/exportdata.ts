/** The shown measurements as CSV and JSON. */
import type { Json, JsonObject } from "../scene/json";
import type { Errors } from "./measure/errors";

/** One quality on one machine. */
export interface Row {
  machine: string;
  id: string;
  label: string;
  tier: string | null;
  /** Of the changed setting. */
  parameter: string | null;
  value: Json;
  onFront: boolean;
  /** Median and quartiles, ms. */
  time: number;
  low: number;
  high: number;
  /** ms; empty where only the model is known. */
  rounds: readonly number[];
  errors: Errors;
}

export interface Shown {
  preset: string;
  /** Timed size, pixels. */
  width: number;
  height: number;
  method: string;
  rows: readonly Row[];
}

const HEADER = [
  ...["machine", "id", "label", "tier", "parameter", "value", "on_front"],
  ...["time_ms", "time_low_ms", "time_high_ms", "rounds_ms", "rmse", "flip", "max", "coverage"],
];

/** RFC 4180 with line feeds; rounds are separated by spaces. */
export function toCsv({ rows }: Shown): string {
  const lines = rows.map((row) => [
    ...[row.machine, row.id, row.label, row.tier ?? "", row.parameter ?? ""],
    ...[row.parameter === null ? "" : JSON.stringify(row.value), row.onFront ? "1" : "0"],
    ...[row.time, row.low, row.high].map(digits),
    row.rounds.map(digits).join(" "),
    ...[row.errors.rmse, row.errors.flip, row.errors.max, row.errors.coverage].map(digits),
  ]);
  return [HEADER, ...lines].map((cells) => `${cells.map(quoted).join(",")}\n`).join("");
}

export function toJson({ preset, width, height, method, rows }: Shown): string {
  const points = rows.map(({ machine, id, label, tier, parameter, value, onFront, time, low, high, rounds, errors }): JsonObject => ({
    ...{ machine, id, label, tier, parameter, value: parameter === null ? null : value, on_front: onFront },
    time: { median_ms: time, low_ms: low, high_ms: high, rounds_ms: [...rounds] },
    error: { ...errors },
  }));
  return `${JSON.stringify({ preset, timing: { width, height }, method, points }, null, 2)}\n`;
}

const digits = (value: number) => String(Number(value.toPrecision(6)));

function quoted(cell: string): string {
  return /[",\n]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell;
}
