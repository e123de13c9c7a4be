/** Figure 5: one wave under the paper's equations, its listing and the filtered look. */
import { signal } from "@preact/signals";
import { Stack } from "../drawing/stack";
import { loadFoamTexture, loadMask, WHITE } from "../maths/mask";
import { CONSTANTS } from "../maths/wave";
import { type FigureContext, type LiveFigure, Slider } from "../parts/live";

export async function make({ api, plate }: FigureContext): Promise<LiveFigure> {
  const [mask, white, texture] = await Promise.all([loadMask(api, "vac-24"), loadMask(api, WHITE), loadFoamTexture(api)]);
  const [intensity, fade] = [signal(4), signal(0.2)];
  const stack = new Stack(plate, mask, white, texture, { rows: 24, thresholds: false, others: [] });
  return {
    controls: (
      <>
        <Slider label="C, divisor" value={intensity} min={0.5} max={30} step={0.1} log />
        <Slider label="Fade of the filtered look" value={fade} min={0} max={0.6} step={0.01} />
      </>
    ),
    inputs: [intensity, fade],
    resize: (width) => stack.resize(width),
    draw: (time, seconds) => stack.draw({ front: { ...CONSTANTS.text, intensity: intensity.value }, exponent: 3, time }, fade.value, seconds),
  };
}
