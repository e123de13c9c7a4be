/** A square patch of a mask's pattern. */
import type { Mask } from "../maths/mask";
import { BLEND, shade, Texels } from "./canvas";

/** Of two patches beside each other. */
export const PATCHES = "patches grid grid-cols-2 gap-0.5 [&_canvas]:aspect-square [&_canvas]:w-full";

/** Sides of a texel on the page, px, and the width of the page from which the greater one holds. */
const [TEXEL, SMALL_TEXEL, WIDE] = [3, 2, 640];

/** Texels along a side of each of two patches. width: of both, px. */
export const patchSide = (width: number) => Math.floor(width / 2 / (width >= WIDE ? TEXEL : SMALL_TEXEL));

export class Patch extends Texels {
  /** side: texels. */
  override resize(side: number): void {
    super.resize(side, side);
  }

  /** Draws the amount of each texel, of its threshold and its number in the patch. */
  draw({ size, values }: Mask, amount: (m: number, i: number) => number): void {
    const { words, canvas: { width } } = this;
    for (let i = 0; i < words.length; i++) {
      const m = values[Math.floor(i / width) * size + (i % width)] ?? 1;
      words[i] = shade(BLEND, amount(m, i));
    }
    this.show();
  }
}
