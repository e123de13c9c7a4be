/** The spectrum of a quality's error beside that of the standard quality and of the reference itself. */
import { useMemo } from "preact/hooks";
import { type Line, LineChart } from "../../charts/linechart";
import { INK } from "../../charts/uplot";
import type { QualityResult } from "../measure/benchmark";
import type { Picture } from "../measure/npy";
import { luminance, radialSpectrum } from "../measure/spectrum";
import { Disclosure } from "../sections";

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
