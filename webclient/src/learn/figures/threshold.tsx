/** Figure 2: a row of thresholds under a saturation that moves. */
import { signal } from "@preact/signals";
import { Plot } from "../drawing/canvas";
import { drawThresholds } from "../drawing/profile";
import { loadMask } from "../maths/mask";
import { CONSTANTS } from "../maths/wave";
import { type FigureContext, type LiveFigure, Slider } from "../parts/live";

export async function make({ api, plate }: FigureContext): Promise<LiveFigure> {
  const mask = await loadMask(api, "vac-1.5");
  const intensity = signal(4);
  const plot = new Plot("Bars of one row of the mask under the saturation; a bubble stands below each bar that the saturation exceeds");
  plate.append(plot.canvas);
  let texel = 2;
  return {
    controls: <Slider label="C, divisor" value={intensity} min={0.5} max={30} step={0.1} log />,
    inputs: [intensity],
    resize: (width) => {
      texel = width / 320;
      plot.resize(width, width >= 640 ? 260 : 200);
    },
    draw: (time) =>
      drawThresholds(plot, mask, { front: { ...CONSTANTS.text, intensity: intensity.value }, exponent: 3, time: 0.7 * time }, texel, plot.width / 64),
  };
}
