/** The foam laboratory: the paper on one screen. */
import "../style.css";
import { effect, type Signal, signal } from "@preact/signals";
import { render } from "preact";
import { Api, messageOf } from "../../api";
import { byId, element, prefersReducedMotion } from "../../ui/dom";
import { Comparison } from "../drawing/canvas";
import { Stack } from "../drawing/stack";
import { followedMask, loadFoamTexture, maskOptions } from "../maths/mask";
import { CONSTANTS } from "../maths/wave";
import { onWidthChange, PlayButton, Select, Slider } from "../parts/live";
import { formatState, type LabState, parseState, RANGES } from "./state";

const LONGEST = 0.1;
const HEADING = "mt-2 mb-0 font-sans text-body/[1.4] font-semibold tracking-[0]";

function Controls({ state, playing, options }: { state: LabState; playing: Signal<boolean>; options: readonly (readonly [string, string])[] }) {
  const { numbers, mask, other } = state;
  const use = (name: keyof typeof CONSTANTS) => {
    numbers.delta.value = CONSTANTS[name].delta;
    numbers.base.value = CONSTANTS[name].base;
  };
  return (
    <>
      <PlayButton playing={playing} />
      <h2 class={HEADING}>Saturation</h2>
      <div class="grid grid-cols-2 gap-1.5">
        <button type="button" class="control px-1.5" onClick={() => use("text")}>Paper’s text</button>
        <button type="button" class="control px-1.5" onClick={() => use("listing")}>Paper’s listing</button>
      </div>
      <Slider label="δ, place of the front" value={numbers.delta} {...RANGES.delta} step={0.01} unit=" rad" />
      <Slider label="E, rise and fall" value={numbers.base} {...RANGES.base} step={0.01} log />
      <Slider label="C, divisor" value={numbers.c} {...RANGES.c} step={0.1} log />
      <Slider label="K, sharpness of crests" value={numbers.k} {...RANGES.k} step={0.1} />
      <h2 class={HEADING}>Threshold</h2>
      <Select label="Mask" value={mask} options={options} />
      <Select label="Second mask" value={other} options={options} />
      <Slider label="Saturation of the patterns" value={numbers.grey} {...RANGES.grey} step={0.01} />
      <Slider label="Fade of the filtered look" value={numbers.fade} {...RANGES.fade} step={0.01} />
      <Slider label="Speed" value={numbers.speed} {...RANGES.speed} step={0.05} unit=" ×" />
    </>
  );
}

async function start(): Promise<void> {
  const api = new Api(new URL("../../", document.baseURI).href);
  const state = parseState(location.hash);
  // A mask that the server does not have is replaced.
  const known = await maskOptions(api);
  const names = new Set(known.map(([name]) => name));
  if (!names.has(state.mask.value)) state.mask.value = "vac-24";
  if (!names.has(state.other.value)) state.other.value = "white";
  const [mask, other, texture] = await Promise.all([followedMask(api, state.mask), followedMask(api, state.other), loadFoamTexture(api)]);
  const playing = signal(!state.paused && !prefersReducedMotion());
  const [strips, patterns] = [element("div", { class: "stage" }), element("div", { class: "stage" })];
  const stack = new Stack(strips, mask.value, other.value, texture, { rows: 22, thresholds: true, others: ["halftone"] });
  const comparison = new Comparison(patterns);
  byId("strips").replaceChildren(strips);
  byId("patterns").prepend(patterns);
  render(<Controls state={state} playing={playing} options={known} />, byId("controls"));
  effect(() => stack.setMasks(mask.value, other.value));
  effect(() => comparison.show(mask.value, other.value, state.numbers.grey.value));
  effect(() => {
    // Every control is part of the address.
    state.paused = !playing.value;
    history.replaceState(null, "", `${location.pathname}${formatState(state)}`);
  });
  run(state, playing, stack, comparison);
  byId("strips").dataset["live"] = "true";
}

function run(state: LabState, playing: Signal<boolean>, stack: Stack, comparison: Comparison): void {
  const [strips, patterns] = [byId("strips"), byId("patterns")];
  const { delta, base, c, k, fade, speed } = state.numbers;
  let last = 0;
  const draw = (seconds: number) =>
    stack.draw({ front: { delta: delta.value, base: base.value, intensity: c.value }, exponent: k.value, time: state.time }, fade.value, seconds);
  const fit = () => {
    stack.resize(strips.clientWidth);
    comparison.resize(patterns.clientWidth);
    draw(0);
  };
  onWidthChange(strips, strips.clientWidth, fit);
  fit();
  const tick = (now: number) => {
    if (playing.value) {
      const seconds = Math.min((now - last) / 1000, LONGEST) * speed.value;
      state.time += seconds;
      draw(Math.max(seconds, 0));
    }
    last = now;
    requestAnimationFrame(tick);
  };
  // A laboratory that stands shows what the controls say.
  effect(() => draw(0));
  requestAnimationFrame(tick);
}

start().catch((error: unknown) => {
  byId("strips").textContent = `The laboratory cannot start: ${messageOf(error)}`;
});
