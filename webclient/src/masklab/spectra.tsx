/** Radially averaged power and anisotropy of the shown masks, as the server measured them. */
import { useMemo } from "preact/hooks";
import { INK, type Line, LineChart } from "../charts/linechart";
import type { LoadedMask } from "./choice";

const LEAST_BINS = 32; // Rings of fewer bins say little about anisotropy
const COLOURS = [INK.accent, INK.teal];

/** Index of the measured grey level nearest to a saturation. */
export function nearestGrey(greys: readonly { grey: number }[], grey: number): number {
  return greys.reduce((best, one, i) => (Math.abs(one.grey - grey) < Math.abs((greys[best]?.grey ?? Infinity) - grey) ? i : best), 0);
}

/** Values at the given frequencies; null beyond a spectrum's own. */
export function resample(frequency: readonly number[], values: readonly (number | null)[], at: readonly number[]): (number | null)[] {
  return at.map((wanted) => {
    const next = frequency.findIndex((one) => one >= wanted - 1e-9);
    const [low, high] = [frequency[next - 1], frequency[next]];
    const [from, to] = [values[next - 1] ?? null, values[next] ?? null];
    if (high === undefined) return null;
    if (Math.abs(high - wanted) < 1e-9 || low === undefined) return low === undefined && high > wanted + 1e-9 ? null : to;
    return from === null || to === null ? null : from + ((to - from) * (wanted - low)) / (high - low);
  });
}

export function Spectra({ masks, grey }: { masks: readonly LoadedMask[]; grey: number }) {
  const charts = useMemo(() => {
    // The finest spectrum's rings; the other mask's are between them.
    const finest = masks.reduce<LoadedMask | null>((best, mask) => (mask.spectrum.frequency.length > (best?.spectrum.frequency.length ?? 0) ? mask : best), null);
    const x = finest?.spectrum.frequency ?? [];
    const lines = (pick: (mask: LoadedMask, level: number) => (number | null)[]): Line[] =>
      masks.map((mask, i) => {
        const { greys, frequency } = mask.spectrum;
        return { label: mask.info.title, colour: COLOURS[i] ?? INK.pale, values: resample(frequency, pick(mask, nearestGrey(greys, grey)), x) };
      });
    const white: Line = { label: "white noise", colour: INK.pale, dashed: true, values: x.map(() => 1) };
    const raps = [...lines((mask, level) => mask.spectrum.greys[level]?.raps ?? []), white];
    const anisotropy = lines(({ spectrum }, level) =>
      (spectrum.greys[level]?.anisotropy_db ?? []).map((value, ring) => ((spectrum.bins[ring] ?? 0) >= LEAST_BINS ? value : null)),
    );
    const first = masks[0]?.spectrum;
    return { x, raps, anisotropy, level: first?.greys[nearestGrey(first.greys, grey)] };
  }, [masks, grey]);
  if (charts.level === undefined) return null;
  const { x, raps, anisotropy, level } = charts;
  return (
    <section class="spectra pt-5.5" aria-label="Spectra">
      <h2 class="font-serif text-[22px]">Spectra</h2>
      <p class="mt-1 mb-2.5 max-w-[74ch] text-soft">
        Of the pattern at grey {level.grey}, measured on the whole periodic tile; dots spread ideally would repeat at {level.principal_frequency} cycles per
        texel. Anisotropy of a random pattern without direction is 0 dB.
      </p>
      <div class="grid grid-cols-2 gap-6.5 [--chart-height:250px] *:min-w-0 phone:grid-cols-1">
        <LineChart title="Radially averaged power spectrum" x={x} lines={raps} xLabel="cycles per texel" yLabel="power, white noise = 1" />
        <LineChart title="Anisotropy" x={x} lines={anisotropy} xLabel="cycles per texel" yLabel="anisotropy, dB" linear />
      </div>
    </section>
  );
}
