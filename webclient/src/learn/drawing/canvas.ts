/** Canvases of the figures, their colours, patches of a mask's pattern, and two masks compared at a grey level. */
import { element } from "../../ui/dom";
import type { Mask } from "../maths/mask";
import { spectrum, unevenness } from "../maths/spectrum";

/** Dark in both themes. */
export const COLORS = {
  ground: "#06121b",
  water: "#123a4e",
  crest: "#4d9bb8",
  foam: "#f2f7f6",
  saturation: "#f3c795",
  other: "#86d3c0",
  faint: "rgb(200 224 234 / 22%)",
  text: "rgb(214 230 236 / 82%)",
  unlit: "#31566a",
} as const;

const WATER = [10, 40, 56] as const;
const FOAM = [242, 247, 246] as const;

const encoded = (linear: number) => 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);
const decoded = (byte: number) => (byte / 255 <= 0.04045 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);

/** Foam over water by the amount in 255ths, blended in linear light; as the words of `ImageData`. */
export const BLEND = Uint32Array.from({ length: 256 }, (_, i) => {
  const a = i / 255;
  const [r = 0, g = 0, b = 0] = WATER.map((water, c) => Math.round(encoded((1 - a) * decoded(water) + a * decoded(FOAM[c] ?? 0))));
  return (255 << 24) | (b << 16) | (g << 8) | r;
});

/** Greys by a threshold in 255ths. */
export const GREYS = Uint32Array.from({ length: 256 }, (_, i) => (255 << 24) | (i << 16) | (i << 8) | i);

/** The word of a colour scale at a share of it. */
export const shade = (scale: Uint32Array, share: number): number => scale[Math.min(255, Math.max(0, Math.round(255 * share)))] ?? 0;

function context2d(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  const context = canvas.getContext("2d");
  if (context === null) throw new Error("This browser has no 2D canvas.");
  return context;
}

/** A plot in CSS pixels, sharp on any screen. */
export class Plot {
  readonly canvas: HTMLCanvasElement;
  readonly context: CanvasRenderingContext2D;
  width = 0;
  height = 0;

  constructor(label: string) {
    this.canvas = element("canvas", { role: "img", "aria-label": label, class: "max-w-full" });
    this.context = context2d(this.canvas);
  }

  resize(width: number, height: number): void {
    const ratio = Math.min(devicePixelRatio, 2);
    this.width = width;
    this.height = height;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.canvas.style.width = `${width}px`;
    this.canvas.style.height = `${height}px`;
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  clear(): void {
    this.context.clearRect(0, 0, this.width, this.height);
  }

  /** A curve through the values of a function of the pixel's column. */
  curve(color: string, y: (x: number) => number, dash: number[] = []): void {
    this.path(color, Array.from({ length: this.width + 1 }, (_, x) => [x, y(x)] as const), dash);
  }

  /** A curve through points. */
  path(color: string, points: readonly (readonly [x: number, y: number])[], dash: number[] = [], width = 2): void {
    const { context } = this;
    context.beginPath();
    for (const [x, y] of points) context.lineTo(x, y);
    context.strokeStyle = color;
    context.lineWidth = width;
    context.lineJoin = "round";
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
  }

  text(text: string, x: number, y: number, color: string = COLORS.text, align: CanvasTextAlign = "left"): void {
    const { context } = this;
    context.font = "12px ui-sans-serif, system-ui, sans-serif";
    context.textAlign = align;
    context.fillStyle = color;
    context.fillText(text, x, y);
  }

  line(x0: number, y0: number, x1: number, y1: number, color: string = COLORS.faint): void {
    this.path(color, [[x0, y0], [x1, y1]], [], 1);
  }
}

/** A picture of texels, each `scale` × `scale` pixels. */
export class Texels {
  readonly canvas: HTMLCanvasElement;
  private readonly context: CanvasRenderingContext2D;
  private image = new ImageData(1, 1);
  words = new Uint32Array(this.image.data.buffer); // Pixels, row by row

  constructor(label: string) {
    this.canvas = element("canvas", { role: "img", "aria-label": label, class: "max-w-full [image-rendering:pixelated]" });
    this.context = context2d(this.canvas);
  }

  resize(width: number, height: number): void {
    this.canvas.width = width;
    this.canvas.height = height;
    this.image = new ImageData(width, height);
    this.words = new Uint32Array(this.image.data.buffer);
  }

  show(): void {
    this.context.putImageData(this.image, 0, 0);
  }
}

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
