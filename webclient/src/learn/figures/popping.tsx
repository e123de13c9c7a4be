/** Figure 3: the same saturation as a fading texture and as bubbles that pop. */
import { element } from "../../ui/dom";
import { Patch, PATCHES, patchSide } from "../drawing/canvas";
import { amount, PopCounter } from "../maths/wave";
import { foamTextures, loadFoamTexture, loadMask } from "../maths/mask";
import type { FigureContext, LiveFigure } from "../parts/live";

/** Between two fronts, and of the decay to 1/e, s. */
const PERIOD = 8;
const DECAY = 2.2;

export async function make({ api, plate }: FigureContext): Promise<LiveFigure> {
  const [mask, texture] = await Promise.all([loadMask(api, "mix"), loadFoamTexture(api)]);
  const faded = new Patch("Foam that fades all at once");
  const popped = new Patch("Foam whose bubbles pop one by one");
  let textures = new Float32Array(0);
  let counter = new PopCounter(0);
  const [saturation, pops] = [element("output"), element("output")];
  plate.append(
    element(
      "div",
      { class: PATCHES },
      element("div", {}, faded.canvas, element("p", { class: "strip-name" }, element("strong", {}, "Faded"), " saturation ", saturation)),
      element("div", {}, popped.canvas, element("p", { class: "strip-name" }, element("strong", {}, "Thresholded"), " ", pops)),
    ),
  );
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
      saturation.textContent = s.toFixed(2);
      pops.textContent = counter.advance(seconds);
    },
  };
}
