/** Canvases of the figures, their colours, and patches of a mask's pattern. */
import { element } from "../../ui/dom";
import type { Mask } from "../maths/mask";

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
