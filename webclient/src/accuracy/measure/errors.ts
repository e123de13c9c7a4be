/** Error of a picture against the reference, in linear light clipped at display white; white is 255 levels. */
import { Flip } from "./flip";
import type { Picture } from "./npy";
import { displayed, type ToneCurve } from "./tone";

export const LEVELS = 255;

export interface Errors {
  /** Root mean square of linear RGB, levels. */
  rmse: number;
  /** Greatest channel difference, levels. */
  max: number;
  /** Of foam coverage, 0 to 1. */
  coverage: number;
  /** Mean FLIP of the displayed pictures, 0 to 1. */
  flip: number;
}

/** The measures of error that the diagrams can show; units are for the axis. */
export const METRICS = [
  { key: "rmse", label: "RMSE", unit: "levels of 255" },
  { key: "flip", label: "FLIP", unit: "0 to 1" },
  { key: "max", label: "maximum", unit: "levels of 255" },
  { key: "coverage", label: "foam coverage", unit: "RMSE, 0 to 1" },
] as const satisfies readonly { key: keyof Errors; label: string; unit: string }[];

export type MetricKey = (typeof METRICS)[number]["key"];

/** Clips to [0, 1]; NaN is 0. */
export const clip = (value: number) => (value > 0 ? Math.min(value, 1) : 0);

/** Compares pictures with one reference. */
export class ErrorMeter {
  private readonly flip: Flip;

  /** `curve`: the scene's tone curve. */
  constructor(readonly truth: Picture, private readonly curve: ToneCurve | null) {
    this.flip = new Flip(displayed(truth, curve), truth.width, truth.height);
  }

  errors(picture: Picture): Errors {
    return { ...pixelErrors(picture, this.truth), flip: this.flip.mean(displayed(picture, this.curve)) };
  }
}

export function pixelErrors(picture: Picture, truth: Picture): Omit<Errors, "flip"> {
  sameSize(picture, truth);
  let squares = 0;
  let coverage = 0;
  let max = 0;
  const { pixels: a } = picture;
  const { pixels: b } = truth;
  for (let i = 0; i < a.length; i += 4) {
    for (let c = i; c < i + 3; c++) {
      const difference = Math.abs(clip(a[c] ?? 0) - clip(b[c] ?? 0));
      squares += difference * difference;
      max = Math.max(max, difference);
    }
    const foam = (a[i + 3] ?? 0) - (b[i + 3] ?? 0);
    coverage += foam * foam;
  }
  const count = a.length / 4;
  return { rmse: LEVELS * Math.sqrt(squares / (3 * count)), max: LEVELS * max, coverage: Math.sqrt(coverage / count) };
}

/** A pixel's error: root mean square of its three channels, levels. */
export function errorAtPixel(picture: Picture, truth: Picture, pixel: number): number {
  let squares = 0;
  for (let c = 4 * pixel; c < 4 * pixel + 3; c++) squares += (clip(picture.pixels[c] ?? 0) - clip(truth.pixels[c] ?? 0)) ** 2;
  return LEVELS * Math.sqrt(squares / 3);
}

/** Each pixel's error. */
export function errorMap(picture: Picture, truth: Picture): Float32Array {
  sameSize(picture, truth);
  return Float32Array.from({ length: truth.width * truth.height }, (_, pixel) => errorAtPixel(picture, truth, pixel));
}

export function percentile(values: Float32Array, share: number): number {
  const sorted = Float32Array.from(values).sort();
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? 0;
}

function sameSize(picture: Picture, truth: Picture): void {
  if (picture.width !== truth.width || picture.height !== truth.height) {
    throw new Error(`The picture has ${picture.width} × ${picture.height} pixels, the reference ${truth.width} × ${truth.height}.`);
  }
}
