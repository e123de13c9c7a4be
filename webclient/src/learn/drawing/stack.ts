/** The wave in profile, thresholds and strips one below another, all along the same water. */
import { element } from "../../ui/dom";
import { coverage, overSample, thresholdOf } from "../maths/filtered";
import { foamTextures, type Mask } from "../maths/mask";
import { amount, type Front, frontSaturation, height, heightSaturation, type Look, LOOKS, phase, PopCounter } from "../maths/wave";
import { BLEND, COLORS, GREYS, Plot, shade, Texels } from "./canvas";

/** Of the wave in the figures, m, and in texels of the mask. */
const WAVELENGTH = 12;
const WAVE_TEXELS = 256;
const METRES = WAVELENGTH / WAVE_TEXELS;
const TOP = 1.25; // Greatest saturation on the plots

interface WaveState {
  front: Front;
  exponent: number; // K of the profile
  time: number; // s
}

/** θ at a place along the strip, texels. */
const phaseAt = (texel: number, time: number) => phase(texel * METRES, time, WAVELENGTH);

/** `texel`: its side, px; `byHeight`: also the saturation by height, for comparison. */
export function drawProfile(plot: Plot, wave: WaveState, texel: number, byHeight = false): void {
  const { context, width, height: tall } = plot;
  const [crest, trough] = [0.56 * tall, 0.94 * tall];
  const [zero, one] = [0.5 * tall, 0.5 * tall * (1 - 1 / TOP)];
  const theta = (x: number) => phaseAt(x / texel, wave.time);
  const surface = (x: number) => trough - (trough - crest) * height(theta(x), wave.exponent);
  const axis = (f: number) => zero - (zero - one) * Math.min(f, TOP);
  plot.clear();
  for (const [f, label] of [[0, "0"], [1, "1"]] as const) {
    plot.line(0, axis(f), width, axis(f));
    plot.text(label, 4, axis(f) - 4);
  }
  const water = context.createLinearGradient(0, crest, 0, tall);
  water.addColorStop(0, COLORS.crest);
  water.addColorStop(1, COLORS.water);
  context.beginPath();
  context.moveTo(0, tall);
  for (let x = 0; x <= width; x++) context.lineTo(x, surface(x));
  context.lineTo(width, tall);
  context.fillStyle = water;
  context.fill();
  foamOnCrest(plot, surface, (x) => frontSaturation(theta(x), wave.front));
  if (byHeight) plot.curve(COLORS.other, (x) => axis(heightSaturation(height(theta(x), wave.exponent), 0.3, 0.9)), [6, 5]);
  context.save();
  context.beginPath();
  context.rect(0, 0, width, zero + 2);
  context.clip();
  plot.curve(COLORS.saturation, (x) => axis(frontSaturation(theta(x), wave.front)));
  context.restore();
  plot.text("saturation f of the front", 18, 14, COLORS.saturation);
  if (byHeight) plot.text("saturation by height", 18, 30, COLORS.other);
}

/** Foam as a band on the water, as thick and white as the saturation says. */
function foamOnCrest({ context, width }: Plot, surface: (x: number) => number, saturation: (x: number) => number): void {
  context.fillStyle = COLORS.foam;
  for (let x = 0; x < width; x++) {
    const f = Math.min(saturation(x), 1);
    if (f < 0.01) continue;
    context.globalAlpha = 0.15 + 0.85 * f;
    context.fillRect(x, surface(x) - 1, 1, 1 + 6 * f);
  }
  context.globalAlpha = 1;
}

/** A row of the mask as bars under the saturation; those that it exceeds are foam. */
export function drawThresholds(plot: Plot, mask: Mask, wave: WaveState, texel: number, bar = texel): void {
  const { context, width, height: tall } = plot;
  const foot = tall - 22;
  const axis = (f: number) => foot - (foot - 8) * Math.min(f, TOP) * (1 / TOP);
  const f = (x: number) => frontSaturation(phaseAt(x / texel, wave.time), wave.front);
  plot.clear();
  for (let i = 0; i * bar < width; i++) {
    const m = mask.values[i % mask.size] ?? 1;
    const lit = f((i + 0.5) * bar) > m;
    const gap = bar > 4 ? 1.5 : bar > 2 ? 0.5 : 0;
    context.fillStyle = lit ? COLORS.foam : COLORS.unlit;
    context.fillRect(i * bar, axis(m), bar - gap, foot - axis(m));
    if (!lit) continue;
    if (bar > 4) {
      context.beginPath();
      context.arc((i + 0.5) * bar, tall - 9, Math.min(0.42 * bar, 7), 0, 7);
      context.fill();
    } else context.fillRect(i * bar, tall - 15, bar - gap, 10);
  }
  plot.curve(COLORS.saturation, (x) => axis(f(x)));
}

const WIDE = 640; // Widths of the page from which a texel is two pixels wide, px

const SCALE = 2; // Pixels along a texel, so that the filtered look has samples smaller than texels

/** `others`: strips under a second mask. */
interface StackOptions { rows: number; thresholds: boolean; others: readonly Look[]; }

export class Stack {
  private readonly profile = new Plot("The wave in profile, with its saturation over it");
  private readonly thresholds = new Plot("A row of the mask as bars under the saturation; bars below it are foam");
  private readonly row = new Texels("A row of the mask: dark texels foam first and pop last");
  private readonly strips: Strip[];
  private readonly others: Strip[];
  private texel = 2;
  private columns = 0;

  constructor(host: HTMLElement, private mask: Mask, other: Mask, texture: Uint8Array, private readonly options: StackOptions) {
    const looks: Look[] = ["halftone", "fading", "halftone_textured", "listing", "filtered"];
    this.strips = looks.map((look) => new Strip(look, LOOKS[look].title, mask, texture, options.rows));
    this.others = options.others.map((look) => new Strip(look, `${LOOKS[look].title}, second mask`, other, texture, options.rows));
    host.append(this.profile.canvas);
    if (options.thresholds) {
      const name = element("p", { class: "strip-name" }, element("strong", {}, "A row of the mask"), " the same numbers as bars and as greys");
      host.append(this.thresholds.canvas, name, this.row.canvas);
    }
    host.append(...[...this.strips, ...this.others].map(({ root }) => root));
  }

  setMasks(mask: Mask, other: Mask): void {
    this.mask = mask;
    for (const strip of this.strips) strip.setMask(mask);
    for (const strip of this.others) strip.setMask(other);
    this.drawRow();
  }

  resize(width: number): void {
    this.texel = width >= WIDE ? 2 : 1;
    this.columns = Math.floor(width / this.texel);
    this.profile.resize(width, width >= WIDE ? 150 : 120);
    this.thresholds.resize(width, width >= WIDE ? 110 : 90);
    for (const strip of [...this.strips, ...this.others]) strip.resize(this.columns, this.texel);
    this.row.resize(this.columns, 1);
    this.row.canvas.style.width = `${this.texel * this.columns}px`;
    this.row.canvas.style.height = "14px";
    this.drawRow();
  }

  private drawRow(): void {
    for (let x = 0; x < this.columns; x++) this.row.words[x] = shade(GREYS, this.mask.values[x % this.mask.size] ?? 0);
    this.row.show();
  }

  draw(wave: WaveState, fade: number, seconds: number): void {
    drawProfile(this.profile, wave, this.texel);
    if (this.options.thresholds) drawThresholds(this.thresholds, this.mask, wave, this.texel);
    const saturation = (texel: number) => frontSaturation(phaseAt(texel, wave.time), wave.front);
    for (const strip of [...this.strips, ...this.others]) strip.draw(saturation, fade, seconds);
  }
}

type Saturation = (texel: number) => number; // Saturation at a place along the strip, texels

/** A strip of water under a passing wave, thresholded by one of the looks. */
class Strip {
  readonly root: HTMLElement;
  private readonly texels: Texels;
  private readonly output = element("output", { class: "rate ml-auto" });
  private counter = new PopCounter(0);
  private textures = new Float32Array(0);
  private samples = new Float32Array(0); // Means and half ranges of the mask's B-spline over the pixels
  private columns = 0;

  constructor(readonly look: Look, title: string, private mask: Mask, private readonly texture: Uint8Array, private readonly rows: number) {
    this.texels = new Texels(`${title}: a strip of water with foam, in motion`);
    this.root = element(
      "div",
      { class: "strip" },
      element("p", { class: "strip-name flex-nowrap whitespace-nowrap" }, element("strong", {}, title), " ", element("span", { class: "truncate opacity-75" }, LOOKS[look].formula), this.output),
      this.texels.canvas,
    );
  }

  /** columns: length, texels; texel: its side on the page, px. */
  resize(columns: number, texel: number): void {
    this.columns = columns;
    this.texels.resize(SCALE * columns, SCALE * this.rows);
    this.texels.canvas.style.width = `${texel * columns}px`;
    this.texels.canvas.style.height = `${texel * this.rows}px`;
    this.prepare();
  }

  setMask(mask: Mask): void {
    if (mask === this.mask) return;
    this.mask = mask;
    this.prepare();
  }

  private prepare(): void {
    const { columns, rows, mask } = this;
    this.counter = new PopCounter(columns * rows);
    if (this.look === "filtered") {
      const samples = new Float32Array(2 * SCALE * columns * SCALE * rows);
      for (let y = 0, i = 0; y < SCALE * rows; y++) {
        for (let x = 0; x < SCALE * columns; x++, i += 2) {
          samples.set(overSample(mask, (x + 0.5) / SCALE, (y + 0.5) / SCALE, 1 / SCALE), i);
        }
      }
      this.samples = samples;
    } else {
      this.textures = foamTextures(this.texture, columns, rows);
    }
  }

  /** seconds: by which time moved since the last frame; fade: of the filtered look. */
  draw(saturation: Saturation, fade: number, seconds: number): void {
    if (this.look === "filtered") this.drawFiltered(saturation, fade);
    else this.drawTexels(this.look, saturation);
    this.texels.show();
    this.output.textContent = this.counter.advance(seconds);
  }

  private drawTexels(look: Exclude<Look, "filtered">, saturation: Saturation): void {
    const { columns, rows, mask, textures, counter } = this;
    const { words } = this.texels;
    const width = SCALE * columns;
    for (let x = 0; x < columns; x++) {
      const f = saturation(x + 0.5);
      const column = x & (mask.size - 1);
      for (let y = 0; y < rows; y++) {
        const a = amount(look, f, mask.values[y * mask.size + column] ?? 1, textures[y * columns + x] ?? 0);
        counter.see(y * columns + x, a);
        const word = shade(BLEND, a);
        const corner = SCALE * (y * width + x);
        words.fill(word, corner, corner + SCALE);
        words.fill(word, corner + width, corner + width + SCALE);
      }
    }
  }

  private drawFiltered(saturation: Saturation, fade: number): void {
    const { columns, rows, mask, samples, counter } = this;
    const { words } = this.texels;
    const width = SCALE * columns;
    for (let x = 0; x < width; x++) {
      const threshold = thresholdOf(mask.quantiles, Math.min(saturation((x + 0.5) / SCALE), 1), fade);
      for (let y = 0; y < SCALE * rows; y++) {
        const i = y * width + x;
        const a = coverage(threshold, samples[2 * i] ?? 0, samples[2 * i + 1] ?? 1);
        words[i] = shade(BLEND, a);
        // One of a texel's samples stands for its bubble.
        if (x % SCALE === 0 && y % SCALE === 0) counter.see((y / SCALE) * columns + x / SCALE, a);
      }
    }
  }
}
