/** Figure 1: foam begins at the front of a wave and fades behind it. */
import { computed, signal } from "@preact/signals";
import { Plot } from "../drawing/canvas";
import { drawProfile } from "../drawing/profile";
import { CONSTANTS } from "../maths/wave";
import { Choice, type FigureContext, type LiveFigure, Slider } from "../parts/live";

export function make({ plate }: FigureContext): LiveFigure {
  const constants = signal<keyof typeof CONSTANTS>("text");
  const [intensity, exponent] = [signal(4), signal(3)];
  const front = computed(() => ({ ...CONSTANTS[constants.value], intensity: intensity.value }));
  const plot = new Plot("A wave in profile; over it the saturation of its front, and for comparison the saturation by height");
  plate.append(plot.canvas);
  let texel = 2;
  return {
    controls: (
      <>
        <Choice label="Constants" value={constants} options={[["text", "of the text"], ["listing", "of the listing"]]} />
        <Slider label="C, divisor" value={intensity} min={0.5} max={30} step={0.1} log />
        <Slider label="K, sharpness of crests" value={exponent} min={1} max={8} step={0.1} />
      </>
    ),
    inputs: [front, exponent],
    resize: (width) => {
      texel = width >= 640 ? 2 : 1;
      plot.resize(width, width >= 640 ? 300 : 220);
    },
    draw: (time) => drawProfile(plot, { front: front.value, exponent: exponent.value, time }, texel, true),
  };
}
