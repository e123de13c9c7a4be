/** Work-precision curves: the values of one quality setting, in order, with the standard quality among them. */
import { get, type Json } from "../../scene/json";
import type { Point } from "../api";
import { valueText } from "../format";

export interface Curve {
  /** Of the setting, in the quality. */
  pointer: string;
  title: string;
  points: { id: string; value: string }[];
}

/** One curve for each setting; the points come in the server's order, the fastest value first. */
export function curvesOf(points: readonly Point[], standard: Point, time: (id: string) => number): Curve[] {
  const byPointer = new Map<string, Point[]>();
  for (const point of points) {
    const pointer = point.parameter?.pointer;
    if (pointer !== undefined) byPointer.set(pointer, [...(byPointer.get(pointer) ?? []), point]);
  }
  return [...byPointer].map(([pointer, list]) => {
    const own = get(standard.quality, pointer) ?? null;
    const values = list.map((point) => ({ id: point.id, value: point.parameter?.value ?? null }));
    const at = placeOf(values, own, time(standard.id), time);
    const all = [...values.slice(0, at), { id: standard.id, value: own }, ...values.slice(at)];
    const title = list[0]?.parameter?.title ?? pointer;
    return { pointer, title, points: all.map(({ id, value }) => ({ id, value: valueText(value) })) };
  });
}

/** Where the standard's value belongs: among numbers by their order, else by its time. */
function placeOf(values: readonly { id: string; value: Json }[], own: Json, ownTime: number, time: (id: string) => number): number {
  const numbers = values.map(({ value }) => value);
  const numeric = typeof own === "number" && numbers.every((value) => typeof value === "number");
  if (numeric && numbers.length > 1) {
    const falling = (numbers[0] ?? 0) > (numbers.at(-1) ?? 0);
    const at = numbers.findIndex((value) => (falling ? value < own : value > own));
    return at < 0 ? numbers.length : at;
  }
  const at = values.findIndex(({ id }) => time(id) > ownTime);
  return at < 0 ? values.length : at;
}
