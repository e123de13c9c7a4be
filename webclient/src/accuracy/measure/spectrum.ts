/** Radially averaged power spectrum of a picture's error. */
import { ringPower } from "../../charts/fourier";
import { clip, LEVELS } from "./errors";
import type { Picture } from "./npy";

/** Weights of linear RGB in luminance (Rec. 709). */
const LUMINANCE = [0.2126, 0.7152, 0.0722] as const;

interface Spectrum {
  /** Centres of the rings, cycles per pixel, up to 0.5. */
  frequency: number[];
  /** Mean power of a ring's bins, levels²: over all bins it sums to the mean square. */
  power: number[];
}

/** Luminance of clipped linear light, levels; without `truth` the picture's own, with it their difference. */
export function luminance(picture: Picture, truth?: Picture): Float64Array {
  const result = new Float64Array(picture.width * picture.height);
  for (let i = 0; i < result.length; i++) {
    LUMINANCE.forEach((weight, c) => {
      const at = 4 * i + c;
      const difference = clip(picture.pixels[at] ?? 0) - (truth ? clip(truth.pixels[at] ?? 0) : 0);
      result[i] = (result[i] ?? 0) + LEVELS * weight * difference;
    });
  }
  return result;
}

/**
 * Rings are as wide as a bin of the shorter side; the mean is left out. A Hann window, normalised to keep the power, holds back the
 * leakage of the borders, which would otherwise hide a steep spectrum's high frequencies.
 */
export function radialSpectrum(values: Float64Array, width: number, height: number, windowed = true): Spectrum {
  const window = (i: number, n: number) => (windowed ? Math.sqrt(2 / 3) * (1 - Math.cos((2 * Math.PI * (i + 0.5)) / n)) : 1);
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  const shaped = values.map((value, i) => (value - mean) * window(i % width, width) * window(Math.floor(i / width), height));
  const side = Math.min(width, height);
  const power = ringPower(shaped, width, Math.floor(side / 2));
  return { frequency: power.map((_, i) => (i + 1) / side), power };
}
