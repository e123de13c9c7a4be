/** The wave in profile with its saturation over it, and a row of thresholds under the saturation. */
import type { Mask } from "../maths/mask";
import { type Front, frontSaturation, height, heightSaturation, phase } from "../maths/wave";
import { COLORS, type Plot } from "./canvas";

/** Of the wave in the figures, m, and in texels of the mask. */
const WAVELENGTH = 12;
const WAVE_TEXELS = 256;
const METRES = WAVELENGTH / WAVE_TEXELS;
/** Greatest saturation on the plots. */
const TOP = 1.25;

export interface WaveState {
  front: Front;
  /** K of the profile. */
  exponent: number;
  /** s */
  time: number;
}

/** θ at a place along the strip, texels. */
export const phaseAt = (texel: number, time: number) => phase(texel * METRES, time, WAVELENGTH);

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
