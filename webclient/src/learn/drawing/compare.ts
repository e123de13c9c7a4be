/** Two masks at a grey level: patterns, spectra and evenness. */
import { element } from "../../ui/dom";
import type { Mask } from "../maths/mask";
import { spectrum, unevenness } from "../maths/spectrum";
import { Plot } from "./canvas";
import { COLORS } from "./palette";
import { Patch, PATCHES, patchSide } from "./patch";
import { drawRaps } from "./raps";

/** Of a pattern before its size is known, texels. */
const SIDE = 128;
/** Boxes whose coverage is compared, texels. */
const BOX = 32;
/** Wait before spectra are computed anew: a slider may still move, ms. */
const SETTLE = 120;

export class Comparison {
  private readonly patches = [new Patch("Pattern of the first mask", SIDE), new Patch("Pattern of the second mask", SIDE)];
  private readonly captions = [element("p", { class: "strip-name" }), element("p", { class: "strip-name" })];
  private readonly plot = new Plot("Radially averaged power spectra of both patterns");
  private timer = 0;
  private shown: readonly [Mask, Mask, number] | null = null;

  constructor(host: HTMLElement) {
    const columns = this.patches.map(({ canvas }, i) => element("div", {}, canvas, this.captions[i] ?? ""));
    host.append(element("div", { class: PATCHES }, ...columns), this.plot.canvas);
  }

  resize(width: number): void {
    const side = patchSide(width);
    for (const patch of this.patches) patch.resize(side);
    this.plot.resize(width, Math.min(240, Math.max(190, 0.4 * width)));
    if (this.shown) this.show(...this.shown);
  }

  /** grey: share of texels that are foam. */
  show(first: Mask, second: Mask, grey: number): void {
    [first, second].forEach((mask, i) => {
      this.patches[i]?.draw(mask, (m) => (m < grey ? 1 : 0));
      const spread = (100 * unevenness(mask, grey, BOX)).toFixed(1);
      this.captions[i]?.replaceChildren(element("strong", {}, mask.title), ` coverage of ${BOX} × ${BOX} texels varies by ±${spread} %`);
    });
    this.shown = [first, second, grey];
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.measure(first, second, grey), SETTLE);
  }

  private measure(first: Mask, second: Mask, grey: number): void {
    if (this.plot.width === 0) return;
    drawRaps(this.plot, [
      { title: first.title, color: COLORS.saturation, spectrum: spectrum(first, grey) },
      { title: second.title, color: COLORS.other, spectrum: spectrum(second, grey) },
    ]);
  }
}
