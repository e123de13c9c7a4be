/** Plot of radially averaged power spectra. */
import type { Spectrum } from "../maths/spectrum";
import type { Plot } from "./canvas";
import { COLORS } from "./palette";

const [LEAST, MOST] = [0.01, 100];
const HIGHEST = 0.7071;
/** Frequencies that one drawn value averages: rings scatter. */
const BAND = 0.008;

interface RapsCurve {
  title: string;
  color: string;
  spectrum: Spectrum;
}

export function drawRaps(plot: Plot, curves: readonly RapsCurve[]): void {
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
  curves.forEach(({ title, color, spectrum }, index) => {
    plot.path(color, smoothed(spectrum).map(([frequency, power]) => [x(frequency), y(power)]));
    // Below the name of the axes, which narrow plots have no room beside.
    plot.text(title, right - 6, top + 30 + 16 * index, color, "right");
  });
}

function smoothed({ frequency, raps }: Spectrum): [number, number][] {
  const points: [number, number][] = [];
  for (let i = 0; i < frequency.length; ) {
    const end = (frequency[i] ?? 0) + BAND;
    let [places, sum, count] = [0, 0, 0];
    for (; i < frequency.length && (frequency[i] ?? 0) < end; i++, count++) {
      places += frequency[i] ?? 0;
      sum += raps[i] ?? 0;
    }
    points.push([places / count, sum / count]);
  }
  return points;
}
