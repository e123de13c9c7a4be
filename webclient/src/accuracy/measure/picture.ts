/** Pictures in linear light: from NumPy's files, and as they are displayed. */
import { get, type Json } from "../../scene/json";

export interface Picture {
  width: number;
  height: number;
  /** RGBA, rows from the top. */
  pixels: Float32Array;
}

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
