/** What the benchmark's pictures show: qualities of equal time and error, a part of the picture, errors as a heat map. */
import { paintPixels } from "../../charts/parts";
import { clip, type Picture, srgb } from "../measure/errors";
import type { Cost } from "../measure/measured";

/** `high`: third quartile of the time, ms. */
type Timed = Cost & { high: number };

const EQUAL_ERROR = 1.02; // Errors closer than this factor are equal

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

const SHARE = 4; // Side of a region as a share of the picture's

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

/** Colour ramp with increasing lightness, from dark blue over red to light yellow. */
const RAMP: readonly (readonly [number, number, number])[] = [
  [6, 10, 18],
  [38, 24, 82],
  [104, 32, 110],
  [170, 48, 94],
  [224, 88, 62],
  [248, 150, 46],
  [252, 208, 98],
  [255, 250, 214],
];

/** Colour of a share in [0, 1]. */
export function heatColour(share: number): [number, number, number] {
  const position = Math.min(1, Math.max(0, share)) * (RAMP.length - 1);
  const low = RAMP[Math.floor(position)] ?? [0, 0, 0];
  const high = RAMP[Math.ceil(position)] ?? low;
  const fraction = position - Math.floor(position);
  return [0, 1, 2].map((c) => Math.round((low[c] ?? 0) * (1 - fraction) + (high[c] ?? 0) * fraction)) as [number, number, number];
}

export const HEAT_GRADIENT = `linear-gradient(to right, ${RAMP.map((colour) => `rgb(${colour.join(" ")})`).join(", ")})`;

const toSrgb = (linear: number) => 255 * srgb(clip(linear));

/** Draws linear light, clipped at display white; of a region, if one is given. */
export function drawPicture(canvas: HTMLCanvasElement, picture: Picture, region?: Region): void {
  const { x, y, width, height } = region ?? { x: 0, y: 0, ...picture };
  paintPixels(canvas, width, height, (pixel) => {
    const at = 4 * ((y + Math.floor(pixel / width)) * picture.width + x + (pixel % width));
    return [0, 1, 2].map((c) => toSrgb(picture.pixels[at + c] ?? 0)) as [number, number, number];
  });
}

/** Draws errors; `max` and above have the ramp's last colour. */
export function drawErrors(canvas: HTMLCanvasElement, width: number, height: number, map: Float32Array, max: number): void {
  paintPixels(canvas, width, height, (pixel) => heatColour((map[pixel] ?? 0) / max));
}
