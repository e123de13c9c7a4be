/** Figures 1 to 5: the wave, its thresholds, bubbles, masks and equations, drawn on canvases. */
import { computed, effect, type Signal, signal } from "@preact/signals";
import { element } from "../../ui/dom";
import { Comparison, Patch, PATCHES, patchSide, Plot } from "../drawing/canvas";
import { drawProfile, drawThresholds, Stack } from "../drawing/stack";
import { followedMask, foamTextures, loadFoamTexture, loadMask, maskOptions, WHITE } from "../maths/mask";
import { amount, CONSTANTS, PopCounter } from "../maths/wave";
import { Choice, type FigureContext, type LiveFigure, Select, Slider } from "../parts/live";

const Divisor = ({ value }: { value: Signal<number> }) => <Slider label="C, divisor" value={value} min={0.5} max={30} step={0.1} log />;

/** Figure 1: foam begins at the front of a wave and fades behind it. */
export function saturation({ plate }: FigureContext): LiveFigure {
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
        <Divisor value={intensity} />
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

/** Figure 2: a row of thresholds under a saturation that moves. */
export async function threshold({ api, plate }: FigureContext): Promise<LiveFigure> {
  const mask = await loadMask(api, "vac-1.5");
  const intensity = signal(4);
  const plot = new Plot("Bars of one row of the mask under the saturation; a bubble stands below each bar that the saturation exceeds");
  plate.append(plot.canvas);
  let texel = 2;
  return {
    controls: <Divisor value={intensity} />,
    inputs: [intensity],
    resize: (width) => {
      texel = width / 320;
      plot.resize(width, width >= 640 ? 260 : 200);
    },
    draw: (time) =>
      drawThresholds(plot, mask, { front: { ...CONSTANTS.text, intensity: intensity.value }, exponent: 3, time: 0.7 * time }, texel, plot.width / 64),
  };
}

/** Between two fronts, and of the decay to 1/e, s. */
const PERIOD = 8;
const DECAY = 2.2;

/** Figure 3: the same saturation as a fading texture and as bubbles that pop. */
export async function popping({ api, plate }: FigureContext): Promise<LiveFigure> {
  const [mask, texture] = await Promise.all([loadMask(api, "mix"), loadFoamTexture(api)]);
  const faded = new Patch("Foam that fades all at once");
  const popped = new Patch("Foam whose bubbles pop one by one");
  let textures = new Float32Array(0);
  let counter = new PopCounter(0);
  const [share, pops] = [element("output"), element("output")];
  const named = ({ canvas }: Patch, name: string, ...text: (Node | string)[]) =>
    element("div", {}, canvas, element("p", { class: "strip-name" }, element("strong", {}, name), ...text));
  plate.append(element("div", { class: PATCHES }, named(faded, "Faded", " saturation ", share), named(popped, "Thresholded", " ", pops)));
  return {
    resize: (width) => {
      const side = patchSide(width);
      for (const patch of [faded, popped]) patch.resize(side);
      textures = foamTextures(texture, side, side);
      counter = new PopCounter(side * side);
    },
    draw: (time, seconds) => {
      const s = Math.exp(-(time % PERIOD) / DECAY);
      faded.draw(mask, (_, i) => amount("textured", s, 0, textures[i] ?? 0));
      popped.draw(mask, (m, i) => {
        const a = amount("halftone", s, m, 1);
        counter.see(i, a);
        return a;
      });
      share.textContent = s.toFixed(2);
      pops.textContent = counter.advance(seconds);
    },
  };
}

/** Figure 4: what a mask's spectrum says of its bubbles. */
export async function masks({ api, plate }: FigureContext): Promise<LiveFigure> {
  const names = [signal("vac-1.5"), signal<string>(WHITE)] as const;
  const [first, second, options] = await Promise.all([followedMask(api, names[0]), followedMask(api, names[1]), maskOptions(api)]);
  const grey = signal(0.25);
  const comparison = new Comparison(plate);
  effect(() => comparison.show(first.value, second.value, grey.value));
  return {
    controls: (
      <>
        <Slider label="Saturation" value={grey} min={0.03} max={0.9} step={0.01} />
        <Select label="First mask" value={names[0]} options={options} />
        <Select label="Second mask" value={names[1]} options={options} />
      </>
    ),
    resize: (width) => comparison.resize(width),
  };
}

/** Figure 5: one wave under the paper's equations, its listing and the filtered look. */
export async function equations({ api, plate }: FigureContext): Promise<LiveFigure> {
  const [mask, white, texture] = await Promise.all([loadMask(api, "vac-24"), loadMask(api, WHITE), loadFoamTexture(api)]);
  const [intensity, fade] = [signal(4), signal(0.2)];
  const stack = new Stack(plate, mask, white, texture, { rows: 24, thresholds: false, others: [] });
  return {
    controls: (
      <>
        <Divisor value={intensity} />
        <Slider label="Fade of the filtered look" value={fade} min={0} max={0.6} step={0.01} />
      </>
    ),
    inputs: [intensity, fade],
    resize: (width) => stack.resize(width),
    draw: (time, seconds) => stack.draw({ front: { ...CONSTANTS.text, intensity: intensity.value }, exponent: 3, time }, fade.value, seconds),
  };
}
