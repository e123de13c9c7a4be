/** The error of a quality: its picture beside the error map or the reference, with a movable split, and its spectrum. */
import { useMemo, useState } from "preact/hooks";
import { Canvas } from "../../charts/parts";
import { INK, type Line, LineChart } from "../../charts/linechart";
import type { QualityResult } from "../measure/benchmark";
import { errorMap, luminance, percentile, radialSpectrum } from "../measure/errors";
import type { Picture } from "../measure/picture";
import { Disclosure } from "../sections";
import { drawErrors, drawPicture, HEAT_GRADIENT } from "./pictures";

/** The colour scale ends at this percentile of the standard quality's errors. */
const LEGEND_PERCENTILE = 0.97;

const LAYER = "absolute inset-0 size-full [image-rendering:pixelated]";

const SIDES = ["error", "reference"] as const;

export function ErrorView({ shown, standard, truth }: { shown: QualityResult; standard: QualityResult; truth: Picture }) {
  const [side, setSide] = useState<(typeof SIDES)[number]>("error");
  const [split, setSplit] = useState("50");
  const { picture, point } = shown;
  const { width, height } = truth;
  // The same scale for all qualities, so that they can be compared.
  const max = useMemo(() => roundUp(percentile(errorMap(standard.picture, truth), LEGEND_PERCENTILE)), [standard, truth]);
  const paintRight = (canvas: HTMLCanvasElement) => {
    if (side === "error") drawErrors(canvas, width, height, errorMap(picture, truth), max);
    else drawPicture(canvas, truth);
  };
  return (
    <figure class="border-t border-line py-3">
      <figcaption class="flex items-center justify-between gap-2.5">
        <span class="text-fine text-soft">{point.label}</span>
        <div class="toggle" role="group" aria-label="Compare with">
          {SIDES.map((name) => (
            <button type="button" class="min-h-11 px-3 text-dim aria-pressed:text-ink aria-pressed:underline aria-pressed:decoration-accent aria-pressed:decoration-2 aria-pressed:underline-offset-[7px]" key={name} aria-pressed={name === side} onClick={() => setSide(name)}>
              {name}
            </button>
          ))}
        </div>
      </figcaption>
      <div class="frame relative overflow-hidden rounded-lg" style={{ "--at": `${split}%`, aspectRatio: `${width} / ${height}` }}>
        <Canvas class={LAYER} label={`Picture at quality ${point.label}`} paint={(canvas) => drawPicture(canvas, picture)} shows={[picture]} />
        <Canvas class={`right ${LAYER} [clip-path:inset(0_0_0_var(--at))]`} label={side === "error" ? `Error map, 0 to ${max} levels` : "Float64 reference"} paint={paintRight} shows={[side, picture, truth, max]} />
        <div class="absolute inset-y-0 left-(--at) w-px bg-[#fff]" />
        <input class="absolute inset-0 size-full touch-pan-y [--track:none]" type="range" min={0} max={100} step={1} value={split} aria-label="Split position" onInput={(event) => setSplit(event.currentTarget.value)} />
      </div>
      <div class={`flex items-center justify-between gap-2.5 pt-2 text-fine text-soft ${side === "error" ? "" : "invisible"}`} style={{ "--ramp": HEAT_GRADIENT }}>
        <span>0</span>
        <i class="h-2 flex-1 rounded-[4px] bg-(image:--ramp)" />
        <span>{`≥ ${max} levels of 255`}</span>
      </div>
    </figure>
  );
}

/** The spectrum of a quality's error beside that of the standard quality and of the reference itself. */
export function SpectrumView({ shown, standard, truth }: { shown: QualityResult; standard: QualityResult; truth: Picture }) {
  const { x, lines } = useMemo(() => {
    const { width, height } = truth;
    const reference = radialSpectrum(luminance(truth), width, height);
    const line = (label: string, colour: string, picture: Picture): Line => {
      return { label, colour, values: radialSpectrum(luminance(picture, truth), width, height).power };
    };
    const others = shown === standard ? [] : [line(`error of ${standard.point.label}`, INK.teal, standard.picture)];
    const own: Line = { label: "the reference itself", colour: INK.pale, dashed: true, values: reference.power };
    return { x: reference.frequency, lines: [line(`error of ${shown.point.label}`, INK.accent, shown.picture), ...others, own] };
  }, [shown, standard, truth]);
  return (
    <Disclosure title="Spectrum of the error" note="power by frequency" open>
      <LineChart title={`Power spectrum of the error of ${shown.point.label}`} x={x} lines={lines} xLabel="cycles per pixel" yLabel="power, levels²" />
    </Disclosure>
  );
}

/** Next number of 1, 2 or 5 times a power of ten. */
function roundUp(value: number): number {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return ([1, 2, 5].find((step) => step * power >= value) ?? 10) * power;
}
