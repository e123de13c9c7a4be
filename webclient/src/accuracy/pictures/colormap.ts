/** Draws linear light as sRGB, and errors as a heat map. */
import { paintPixels } from "../../charts/canvas";
import { clip } from "../measure/errors";
import type { Picture } from "../measure/npy";
import { srgb } from "../measure/tone";
import type { Region } from "./insets";

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
