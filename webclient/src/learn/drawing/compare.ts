/** Two masks at a grey level: patterns, spectra and evenness. */
import { element } from "../../ui/dom";
import type { Mask } from "../maths/mask";
import { spectrum, unevenness } from "../maths/spectrum";
import { COLORS, Patch, PATCHES, patchSide, Plot } from "./canvas";

const BOX = 32; // Boxes whose coverage is compared, texels
const SETTLE = 120; // Wait before spectra are computed anew: a slider may still move, ms
/** Of the plot of spectra: its powers, and its highest frequency. */
const [LEAST, MOST] = [0.01, 100];
const HIGHEST = 0.7071;
const BAND = 0.008; // Frequencies that one drawn value averages: rings scatter

export class Comparison {
  private readonly patches = [new Patch("Pattern of the first mask"), new Patch("Pattern of the second mask")];
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
    const curve = (mask: Mask, color: string) => ({ title: mask.title, color, points: spectrum(mask, grey) });
    drawSpectra(this.plot, [curve(first, COLORS.saturation), curve(second, COLORS.other)]);
  }
}

/** Plots radially averaged power spectra. */
function drawSpectra(plot: Plot, curves: readonly { title: string; color: string; points: readonly [number, number][] }[]): void {
  const { width, height } = plot;
  const [left, right, top, foot] = [36, width - 8, 12, height - 26];
  const x = (frequency: number) => left + ((right - left) * frequency) / HIGHEST;
  const y = (power: number) => foot - ((foot - top) * Math.log(Math.min(Math.max(power, LEAST), MOST) / LEAST)) / Math.log(MOST / LEAST);
  plot.clear();
  for (const power of [0.01, 0.1, 1, 10, 100]) {
    plot.line(left, y(power), right, y(power));
    plot.text(String(power), left - 6, y(power) + 4, COLORS.text, "right");
  }
  for (const frequency of [0, 0.25, 0.5]) plot.text(String(frequency), x(frequency), foot + 15, COLORS.text, "center");
  plot.text("power by cycles per texel", left + 6, top + 14);
  curves.forEach(({ title, color, points }, index) => {
    plot.path(color, smoothed(points).map(([frequency, power]) => [x(frequency), y(power)]));
    // Below the name of the axes, which narrow plots have no room beside.
    plot.text(title, right - 6, top + 30 + 16 * index, color, "right");
  });
}

/** Means of bands of frequencies. */
function smoothed(points: readonly [frequency: number, power: number][]): [number, number][] {
  const means: [number, number][] = [];
  for (let i = 0; i < points.length; ) {
    const end = (points[i]?.[0] ?? 0) + BAND;
    const band = points.slice(i).filter(([frequency]) => frequency < end);
    const mean = (of: 0 | 1) => band.reduce((sum, point) => sum + point[of], 0) / band.length;
    means.push([mean(0), mean(1)]);
    i += band.length;
  }
  return means;
}
