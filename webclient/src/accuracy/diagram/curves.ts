/** Work-precision curves, and the places of labels in their diagram. */
import { get, type Json } from "../../scene/json";
import type { Point } from "../api";
import { valueText } from "../measure/measured";

export interface Curve {
  pointer: string; // Of the setting, in the quality
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

type Spot = { id: string; x: number; y: number };
type Label = Spot & { text: string; anchor: "start" | "middle" | "end" };

const LETTER = 6.4; // Width of a letter, px

const OFFSETS: readonly [number, number, Label["anchor"]][] = [
  [11, 4, "start"],
  [-11, 4, "end"],
  [0, -12, "middle"],
  [0, 21, "middle"],
  [9, -9, "start"],
  [9, 17, "start"],
  [-9, -9, "end"],
  [-9, 17, "end"],
];

type Box = [left: number, top: number, right: number, bottom: number];

export function placeLabels(named: readonly (Spot & { text: string })[], all: readonly Spot[], width: number, height: number): Label[] {
  const placed: Box[] = [];
  return named.map(({ id, x, y, text }) => {
    const length = LETTER * text.length;
    const candidates = OFFSETS.map(([dx, dy, anchor]) => {
      const left = x + dx - { start: 0, middle: length / 2, end: length }[anchor];
      const box: Box = [left, y + dy - 11, left + length, y + dy + 3];
      const outside = box[0] < 4 || box[2] > width - 2 || box[1] < 4 || box[3] > height - 24;
      const crossed = placed.filter((b) => box[0] < b[2] && b[0] < box[2] && box[1] < b[3] && b[1] < box[3]).length;
      const covered = all.filter((m) => m.id !== id && m.x > box[0] - 5 && m.x < box[2] + 5 && m.y > box[1] - 5 && m.y < box[3] + 5).length;
      return { label: { id, text, anchor, x: x + dx, y: y + dy }, box, penalty: (outside ? 100 : 0) + 20 * crossed + covered };
    });
    const best = candidates.reduce((a, b) => (b.penalty < a.penalty ? b : a));
    placed.push(best.box);
    return best.label;
  });
}
