/** Masks and their halftone patterns as pictures. */
import type { Show } from "./choice";

export interface Mask {
  /** Texels along each side. */
  size: number;
  /** floor(rank 65536 / N), row by row. */
  values: Uint16Array;
}

/** Side of the enlarged part, texels. */
const DETAIL = 64;

/** Whether foam shows in each texel: saturation above the threshold (v + 1/2) / 65536. */
export function threshold({ values }: Mask, saturation: number): Uint8Array {
  return Uint8Array.from(values, (value) => (saturation > (value + 0.5) / 65536 ? 1 : 0));
}

/** Share of foam, 0 to 1. */
export function coverage(pattern: Uint8Array): number {
  return pattern.reduce((sum, foam) => sum + foam, 0) / pattern.length;
}

/** Side of a view, texels, and its first texel; masks repeat beyond their border. */
export function viewOf(size: number, show: Show): { side: number; first: number } {
  if (show === "tiled") return { side: 2 * size, first: 0 };
  return show === "detail" ? { side: Math.min(DETAIL, size), first: size - Math.min(DETAIL, size) / 2 } : { side: size, first: 0 };
}

/** Grey of every pixel of a view, 0 to 255. `grey`: saturation of the pattern; null: the mask itself. */
export function shades(mask: Mask, grey: number | null, show: Show): Uint8ClampedArray {
  const { side, first } = viewOf(mask.size, show);
  const foam = grey === null ? null : threshold(mask, grey);
  return Uint8ClampedArray.from({ length: side * side }, (_, i) => {
    const [x, y] = [(first + (i % side)) % mask.size, (first + Math.floor(i / side)) % mask.size];
    const at = y * mask.size + x;
    return foam === null ? (mask.values[at] ?? 0) >> 8 : 255 * (foam[at] ?? 0);
  });
}

export function drawShades(canvas: HTMLCanvasElement, values: Uint8ClampedArray): void {
  const side = Math.sqrt(values.length);
  canvas.width = side;
  canvas.height = side;
  const context = canvas.getContext("2d");
  if (context === null) return;
  const image = context.createImageData(side, side);
  values.forEach((value, i) => image.data.set([value, value, value, 255], 4 * i));
  context.putImageData(image, 0, 0);
}
