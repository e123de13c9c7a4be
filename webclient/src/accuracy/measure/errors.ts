/** Pictures in linear light, as they are displayed, and their error against the reference, clipped at display white; white is 255 levels. */
import { ringPower } from "../../charts/fourier";
import { get, type Json } from "../../scene/json";
import { Flip } from "./flip";

/** `pixels`: RGBA, rows from the top. */
export interface Picture { width: number; height: number; pixels: Float32Array; }

const MAGIC = [0x93, 0x4e, 0x55, 0x4d, 0x50, 0x59];

/** Reads a (height, width, 4) array; throws an `Error` for any other. */
export function readPicture(buffer: ArrayBuffer): Picture {
  const bytes = new Uint8Array(buffer);
  if (!MAGIC.every((byte, i) => bytes[i] === byte)) throw new Error("The reference picture is not a .npy file.");
  const view = new DataView(buffer);
  const longHeader = (bytes[6] ?? 1) > 1;
  const start = longHeader ? 12 : 10;
  if (buffer.byteLength < start) throw new Error("The reference picture is truncated.");
  const length = longHeader ? view.getUint32(8, true) : view.getUint16(8, true);
  const header = new TextDecoder("latin1").decode(bytes.subarray(start, start + length));
  const type = /'descr':\s*'([^']*)'/.exec(header)?.[1];
  const shape = /'shape':\s*\(([^)]*)\)/.exec(header)?.[1]?.split(",").map((part) => part.trim()).filter(Boolean).map(Number) ?? [];
  const [height, width, channels] = shape;
  if (type !== "<f4" || !/'fortran_order':\s*False/.test(header) || shape.length !== 3 || channels !== 4 || !height || !width) {
    throw new Error(`The reference picture has type ${type ?? "unknown"} and shape (${shape.join(", ")}); required: float32 (height, width, 4).`);
  }
  const count = height * width * 4;
  const data = start + length;
  if (buffer.byteLength < data + 4 * count) throw new Error("The reference picture is truncated.");
  // Copied, since the data may not be aligned to four bytes.
  return { width, height, pixels: new Float32Array(buffer.slice(data, data + 4 * count)) };
}

export type ToneCurve = "filmic" | "photographic";
type Rgb = [number, number, number];

/** The scene's tone curve; null where it is unlit and light is only clipped. */
export function toneCurve(scene: Json): ToneCurve | null {
  if ((get(scene, "/light") ?? null) === null) return null;
  return get(scene, "/light/tone") === "photographic" ? "photographic" : "filmic";
}

/** sRGB in [0, 1], three values a pixel, without glare. */
export function displayed({ pixels }: Picture, curve: ToneCurve | null): Float64Array {
  const shown = new Float64Array((3 * pixels.length) / 4);
  for (let i = 0, j = 0; i < pixels.length; i += 4, j += 3) {
    const light: Rgb = [positive(pixels[i]), positive(pixels[i + 1]), positive(pixels[i + 2])];
    const mapped = curve === "photographic" ? photographic(light) : curve === "filmic" ? filmic(light) : light;
    for (let c = 0; c < 3; c++) shown[j + c] = srgb(Math.min(1, Math.max(0, mapped[c] ?? 0)));
  }
  return shown;
}

/** The sRGB curve of linear light in [0, 1]. */
export const srgb = (x: number) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);

/** NaN and what is below black are 0. */
const positive = (x: number | undefined) => (x !== undefined && x > 0 ? x : 0);

const filmic = (light: Rgb) => light.map((x) => (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)) as Rgb;

function photographic(light: Rgb): Rgb {
  const [r, g, b] = light;
  const norm = (r ** 3 + g ** 3 + b ** 3) / Math.max(r * r + g * g + b * b, 1e-12);
  const level = shoulder(norm);
  return light.map((x) => {
    const hue = Math.max(1 + 1.2 * (x / Math.max(norm, 1e-6) - 1), 0);
    return level * hue + level * level * (shoulder(x) - level * hue);
  }) as Rgb;
}

const shoulder = (x: number) => Math.min((1.01 * x * (x + 0.02)) / (x * (x + 0.42) + 0.05), 1);

export const LEVELS = 255;

export interface Errors {
  rmse: number; // Root mean square of linear RGB, levels
  max: number; // Greatest channel difference, levels
  coverage: number; // Of foam coverage, 0 to 1
  flip: number; // Mean FLIP of the displayed pictures, 0 to 1
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

const LUMINANCE = [0.2126, 0.7152, 0.0722] as const; // Weights of linear RGB in luminance (Rec. 709).

interface Spectrum {
  frequency: number[]; // Centres of the rings, cycles per pixel, up to 0.5
  power: number[]; // Mean power of a ring's bins, levels²: over all bins it sums to the mean square
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
