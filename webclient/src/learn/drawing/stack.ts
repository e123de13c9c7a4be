/** Wave, thresholds and strips one below another, all along the same water. */
import { element } from "../../ui/dom";
import { LOOK_TITLES, type Look } from "../maths/looks";
import type { Mask } from "../maths/mask";
import { frontSaturation } from "../maths/wave";
import { Plot, Texels } from "./canvas";
import { GREYS, shade } from "./palette";
import { drawProfile, drawThresholds, phaseAt, type WaveState } from "./profile";
import { Strip } from "./strip";

const FORMULAS: Record<Look, string> = {
  textured: "a = f · t",
  halftone: "a = 1 where f > m",
  fading: "a = f/2 − m where f > m",
  halftone_textured: "a = (f/2 − m) · t where f > m",
  listing: "a = max(f − m, 0.15) · t where f > m",
  filtered: "a = the share of the pixel where f > m",
};

/** Widths of the page from which a texel is two pixels wide, px. */
const WIDE = 640;

interface StackOptions {
  rows: number;
  thresholds: boolean;
  /** Strips under a second mask. */
  others: readonly Look[];
}

export class Stack {
  private readonly profile = new Plot("The wave in profile, with its saturation over it");
  private readonly thresholds = new Plot("A row of the mask as bars under the saturation; bars below it are foam");
  private readonly row = new Texels("A row of the mask: dark texels foam first and pop last");
  private readonly strips: Strip[];
  private readonly others: Strip[];
  private texel = 2;
  private columns = 0;

  constructor(
    host: HTMLElement,
    private mask: Mask,
    other: Mask,
    texture: Uint8Array,
    private readonly options: StackOptions,
  ) {
    const looks: Look[] = ["halftone", "fading", "halftone_textured", "listing", "filtered"];
    this.strips = looks.map((look) => new Strip(look, LOOK_TITLES[look], FORMULAS[look], mask, texture, options.rows));
    this.others = options.others.map(
      (look) => new Strip(look, `${LOOK_TITLES[look]}, second mask`, FORMULAS[look], other, texture, options.rows),
    );
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
