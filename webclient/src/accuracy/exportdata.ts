/** The shown measurements as CSV and JSON. */
import type { JsonObject } from "../scene/json";
import { type Measured, type Ranked, ranked } from "./measure/measured";

/** One quality on one machine. */
type Row = Ranked & { machine: string };

export interface ExportedRun {
  preset: string;
  /** Timed size, pixels. */
  width: number;
  height: number;
  method: string;
  rows: readonly Row[];
}

export function rowsOf(measured: readonly Measured[], machine: string): Row[] {
  return ranked(measured, "rmse").map((one) => ({ ...one, machine }));
}

const HEADER = [
  ...["machine", "id", "label", "tier", "parameter", "value", "on_front"],
  ...["time_ms", "time_low_ms", "time_high_ms", "rounds_ms", "rmse", "flip", "max", "coverage"],
];

/** RFC 4180 with line feeds; rounds are separated by spaces. */
export function toCsv({ rows }: ExportedRun): string {
  const lines = rows.map(({ machine, point: { id, label, tier, parameter }, onFront, time, low, high, rounds, errors }) => [
    ...[machine, id, label, tier ?? "", parameter?.pointer ?? "", parameter ? JSON.stringify(parameter.value) : ""],
    ...[onFront ? "1" : "0", ...[time, low, high].map(digits), rounds.map(digits).join(" ")],
    ...[errors.rmse, errors.flip, errors.max, errors.coverage].map(digits),
  ]);
  return [HEADER, ...lines].map((cells) => `${cells.map(quoted).join(",")}\n`).join("");
}

export function toJson({ preset, width, height, method, rows }: ExportedRun): string {
  const points = rows.map(({ machine, point: { id, label, tier, parameter }, onFront, time, low, high, rounds, errors }): JsonObject => ({
    ...{ machine, id, label, tier, parameter: parameter?.pointer ?? null, value: parameter?.value ?? null, on_front: onFront },
    time: { median_ms: time, low_ms: low, high_ms: high, rounds_ms: [...rounds] },
    error: { ...errors },
  }));
  return `${JSON.stringify({ preset, timing: { width, height }, method, points }, null, 2)}\n`;
}

const digits = (value: number) => String(Number(value.toPrecision(6)));

const quoted = (cell: string) => (/[",\n]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell);
