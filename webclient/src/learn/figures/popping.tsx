/** Figure 3: the same saturation as a fading texture and as bubbles that pop. */
import { render } from "preact";
import { element } from "../../ui/dom";
import { Patch, PATCHES } from "../drawing/patch";
import { amount } from "../maths/looks";
import { loadMask } from "../maths/mask";
import { PopCounter, PopRate } from "../maths/pops";
import { PlayButton } from "../parts/controls";
import type { FigureContext, LiveFigure } from "../parts/live";
import { foamTexture, loadFoamTexture } from "../parts/texture";

/** Sides of a texel on the page, px, and the width from which the greater one holds. */
const [TEXEL, SMALL_TEXEL, WIDE] = [3, 2, 640];
/** Between two fronts, and of the decay to 1/e, s. */
const PERIOD = 8;
const DECAY = 2.2;

export async function make({ api, plate, controls, playing }: FigureContext): Promise<LiveFigure> {
  const [mask, texture] = await Promise.all([loadMask(api, "mix"), loadFoamTexture(api)]);
  const faded = new Patch("Foam that fades all at once", 1);
  const popped = new Patch("Foam whose bubbles pop one by one", 1);
  let textures = new Float32Array(0);
  let counter = new PopCounter(0);
  let rate = new PopRate(counter);
  const [saturation, pops] = [element("output"), element("output")];
  plate.append(
    element(
      "div",
      { class: PATCHES },
      element("div", {}, faded.canvas, element("p", { class: "strip-name" }, element("strong", {}, "Faded"), " saturation ", saturation)),
      element("div", {}, popped.canvas, element("p", { class: "strip-name" }, element("strong", {}, "Thresholded"), " ", pops)),
    ),
  );
  render(<PlayButton playing={playing} />, controls);
  return {
    resize: (width) => {
      const side = Math.floor(width / 2 / (width >= WIDE ? TEXEL : SMALL_TEXEL));
      for (const patch of [faded, popped]) patch.resize(side);
      textures = Float32Array.from({ length: side * side }, (_, i) => foamTexture(texture, (i % side) + 0.5, Math.floor(i / side) + 0.5));
      counter = new PopCounter(side * side);
      rate = new PopRate(counter);
    },
    draw: (time, seconds) => {
      const s = Math.exp(-(time % PERIOD) / DECAY);
      faded.draw(mask, (_, i) => amount("textured", s, 0, textures[i] ?? 0));
      popped.draw(mask, (m, i) => {
        const a = amount("halftone", s, m, 1);
        counter.see(i, a);
        return a;
      });
      rate.advance(seconds);
      saturation.textContent = s.toFixed(2);
      pops.textContent = `${Math.round(rate.perSecond).toLocaleString("en")} pops/s`;
    },
  };
}
