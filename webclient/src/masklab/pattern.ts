/** Masks and their halftone patterns as pictures. */
import type { Show } from "./choice";

export interface Mask {
  /** Texels. */
  width: number;
  height: number;
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
export const coverage = (pattern: Uint8Array) => pattern.reduce((sum, foam) => sum + foam, 0) / pattern.length;

/** How much of one side of a mask a view shows, texels, and its first texel; masks repeat beyond their border. */
export function viewOf(side: number, show: Show): { shown: number; first: number } {
  if (show === "tiled") return { shown: 2 * side, first: 0 };
  const shown = Math.min(DETAIL, side);
  return show === "detail" ? { shown, first: side - Math.floor(shown / 2) } : { shown: side, first: 0 };
}

/** Grey of every pixel of a view, 0 to 255. `grey`: saturation of the pattern; null: the mask itself. */
export function shades(mask: Mask, grey: number | null, show: Show): Uint8ClampedArray {
  const [across, down] = [viewOf(mask.width, show), viewOf(mask.height, show)];
  const foam = grey === null ? null : threshold(mask, grey);
  return Uint8ClampedArray.from({ length: across.shown * down.shown }, (_, i) => {
    const [x, y] = [(across.first + (i % across.shown)) % mask.width, (down.first + Math.floor(i / across.shown)) % mask.height];
    const at = y * mask.width + x;
    return foam === null ? (mask.values[at] ?? 0) >> 8 : 255 * (foam[at] ?? 0);
  });
}
