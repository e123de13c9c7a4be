/** What an inset shows: qualities of equal time and of equal error, and a part of the picture. */
import type { Cost } from "../measure/statistics";

/** `high`: third quartile of the time, ms. */
type Timed = Cost & { high: number };

/** Errors closer than this factor are equal. */
const EQUAL_ERROR = 1.02;

/** The most exact other quality that takes no longer than the chosen one's third quartile. */
export function equalTime<T extends Timed>(chosen: T, all: readonly T[]): T | null {
  const others = all.filter(({ id, time }) => id !== chosen.id && time <= chosen.high);
  return least(others, ({ error }) => error);
}

/** The fastest other quality whose error is no greater than the chosen one's. */
export function equalError<T extends Timed>(chosen: T, all: readonly T[]): T | null {
  const others = all.filter(({ id, error }) => id !== chosen.id && error <= EQUAL_ERROR * chosen.error);
  return least(others, ({ time }) => time);
}

function least<T>(list: readonly T[], value: (item: T) => number): T | null {
  return list.reduce<T | null>((best, item) => (best === null || value(item) < value(best) ? item : best), null);
}

export type Pixel = { x: number; y: number };
export type Region = Pixel & { width: number; height: number };

/** Side of a region as a share of the picture's. */
const SHARE = 4;

/** The part of the picture around a pixel, a quarter of it along each side. */
export function regionAround({ x, y }: Pixel, width: number, height: number): Region {
  const [w, h] = [Math.max(1, Math.round(width / SHARE)), Math.max(1, Math.round(height / SHARE))];
  const start = (at: number, side: number, whole: number) => Math.min(whole - side, Math.max(0, at - Math.floor(side / 2)));
  return { x: start(x, w, width), y: start(y, h, height), width: w, height: h };
}

/** The pixel with the greatest value. */
export function worstPixel(map: Float32Array, width: number): Pixel {
  let at = 0;
  for (let i = 1; i < map.length; i++) if ((map[i] ?? 0) > (map[at] ?? 0)) at = i;
  return { x: at % width, y: Math.floor(at / width) };
}
