/** Radially averaged power spectrum of a picture's error. */
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
  const rings = Math.floor(side / 2);
  const sums = new Float64Array(rings + 1);
  const counts = new Float64Array(rings + 1);
  const power = planePower(shaped, width, height);
  for (let ky = 0; ky < height; ky++) {
    for (let kx = 0; kx < width; kx++) {
      const fx = Math.min(kx, width - kx) / width;
      const fy = Math.min(ky, height - ky) / height;
      const ring = Math.round(Math.hypot(fx, fy) * side);
      if (ring === 0 || ring > rings) continue;
      sums[ring] = (sums[ring] ?? 0) + (power[ky * width + kx] ?? 0);
      counts[ring] = (counts[ring] ?? 0) + 1;
    }
  }
  const list = Array.from({ length: rings }, (_, i) => i + 1);
  return { frequency: list.map((ring) => ring / side), power: list.map((ring) => (sums[ring] ?? 0) / (counts[ring] ?? 1)) };
}

/** |DFT|² / N² of real values, (height, width): it sums to the mean square (Parseval). */
function planePower(values: Float64Array, width: number, height: number): Float64Array {
  const rows = [new Float64Array(values.length), new Float64Array(values.length)] as const;
  for (let y = 0; y < height; y++) {
    transform((i) => [values[y * width + i] ?? 0, 0], width, (k, re, im) => {
      rows[0][y * width + k] = re;
      rows[1][y * width + k] = im;
    });
  }
  const power = new Float64Array(values.length);
  for (let x = 0; x < width; x++) {
    transform((i) => [rows[0][i * width + x] ?? 0, rows[1][i * width + x] ?? 0], height, (k, re, im) => {
      power[k * width + x] = (re * re + im * im) / values.length ** 2;
    });
  }
  return power;
}

/** The discrete Fourier transform by its definition: sides are short and of any length. */
function transform(read: (i: number) => [number, number], length: number, write: (k: number, re: number, im: number) => void): void {
  const cosines = Float64Array.from({ length }, (_, i) => Math.cos((2 * Math.PI * i) / length));
  const sines = Float64Array.from({ length }, (_, i) => Math.sin((2 * Math.PI * i) / length));
  const [re, im] = [new Float64Array(length), new Float64Array(length)];
  for (let i = 0; i < length; i++) [re[i], im[i]] = read(i);
  for (let k = 0; k < length; k++) {
    let [sumRe, sumIm] = [0, 0];
    for (let i = 0, turn = 0; i < length; i++, turn = (turn + k) % length) {
      const [c, s, a, b] = [cosines[turn] ?? 0, sines[turn] ?? 0, re[i] ?? 0, im[i] ?? 0];
      sumRe += a * c + b * s;
      sumIm += b * c - a * s;
    }
    write(k, sumRe, sumIm);
  }
}
