/** The mask laboratory, a page of its own: one mask or two, shipped or of parameters, their patterns, spectra, files and code. */
import "../style.css";
import { signal } from "@preact/signals";
import { type ComponentChildren, render } from "preact";
import { useLayoutEffect, useMemo } from "preact/hooks";
import { Api, type Choice, messageOf } from "../api";
import { Canvas, paintPixels } from "../charts/parts";
import { Progress, RangeInput, Select } from "../ui/controls";
import { byId } from "../ui/dom";
import { ASPECT_RANGE, choiceText, coverage, type CustomMask, decodeState, encodeState, FAMILIES, type LabState, type LoadedMask, type MaskChoice, type MaskInfo, type MaskState, SEED_RANGE, shades, type Show, SHOWS, SIDE_RANGE, SIGMA_RANGE, threshold, useMask, viewOf } from "./choice";
import { Spectra } from "./spectra";
import { TakeHome } from "./takehome";

const TITLES: Record<(typeof FAMILIES)[number], string> = {
  vac: "void and cluster",
  blur: "filtered noise",
  clump: "clumps",
  bubble: "bubbles",
  mix: "clustered bubbles",
  lace: "lace",
};
const FIELD = "flex min-h-11 min-w-0 items-center gap-2.5 text-soft";
/** Below its name where two masks share a phone. */
const PICK = "min-h-11 max-w-full min-w-0 rounded-md bg-hover px-2.5 text-ink phone:flex-1 paired:w-full paired:flex-[1_1_100%]";
const CUSTOM = ":custom";
const FIRST: CustomMask = { family: "vac", sigma: 3, width: 128, height: 128, seed: 1, aspect: 1, age: 0 };

interface ControlsProps {
  name: string;
  choice: MaskChoice;
  shipped: readonly { name: string; title: string }[];
  info: MaskInfo | null; // What is shown now: the start of own parameters
  change: (choice: MaskChoice) => void;
}

function Controls({ name, choice, shipped, info, change }: ControlsProps) {
  const custom = typeof choice === "string" ? null : choice;
  const set = (part: Partial<CustomMask>) => change({ ...(custom ?? FIRST), ...part });
  const family = FAMILIES.find((one) => one === info?.family);
  return (
    <div class="flex flex-wrap content-start gap-x-5.5 gap-y-1 paired:flex-col paired:flex-nowrap" role="group" aria-label={name}>
      <Field label="Mask">
        <Select
          class={PICK}
          label={`${name}: mask`}
          value={typeof choice === "string" ? choice : CUSTOM}
          options={[...shipped.map((one) => [one.name, one.title] as const), [CUSTOM, "own parameters"]]}
          // A shipped mask of 512 texels may take longer than a request may.
          choose={(value) => change(value === CUSTOM ? { ...FIRST, ...(family ? { family, sigma: family === "vac" ? FIRST.sigma : 4 } : {}) } : value)}
        />
      </Field>
      {custom && (
        <>
          <Field label="Family">
            <Select class={PICK} label={`${name}: family`} value={custom.family} options={FAMILIES.map((one) => [one, TITLES[one]] as const)} choose={(chosen) => set({ family: chosen })} />
          </Field>
          <Slider label="σ" name={`${name}: sigma, texels`} value={custom.sigma} range={SIGMA_RANGE} step={0.5} change={(sigma) => set({ sigma })} />
          {custom.family === "lace" && (
            <>
              <Slider label="aspect" name={`${name}: aspect`} value={custom.aspect} range={ASPECT_RANGE} step={0.5} change={(aspect) => set({ aspect })} />
              <Slider label="age" name={`${name}: age`} value={custom.age} range={[0, 1]} step={0.05} change={(age) => set({ age })} />
            </>
          )}
          <NumberField label="Width" name={`${name}: width, texels`} value={custom.width} range={SIDE_RANGE} change={(width) => set({ width })} />
          <NumberField label="Height" name={`${name}: height, texels`} value={custom.height} range={SIDE_RANGE} change={(height) => set({ height })} />
          <NumberField label="Seed" name={`${name}: seed`} value={custom.seed} range={SEED_RANGE} change={(seed) => set({ seed })} />
        </>
      )}
    </div>
  );
}

/** A control beside its name, which the control has as its own label. */
function Field({ label, children }: { label: string; children: ComponentChildren }) {
  return (
    <div class={`${FIELD} paired:flex-wrap paired:gap-x-2 paired:gap-y-0`}><span aria-hidden="true">{label}</span>{children}</div>
  );
}

interface NumberProps {
  label: string;
  name: string;
  value: number;
  range: readonly [number, number];
  change: (value: number) => void;
}

/** A whole number, held to its range. */
function NumberField({ label, name, value, range: [low, high], change }: NumberProps) {
  return (
    <Field label={label}>
      <input
        type="number"
        class={`${PICK} w-[13ch]`}
        aria-label={name}
        min={low}
        max={high}
        step={1}
        value={value}
        onChange={(event) => change(Math.min(high, Math.max(low, Math.round(event.currentTarget.valueAsNumber) || low)))}
      />
    </Field>
  );
}

function Slider({ label, name, value, range: [low, high], step, change }: NumberProps & { step: number }) {
  return (
    <Field label={label}>
      <RangeInput class="w-[150px] paired:w-full paired:flex-[1_1_100%]" label={name} value={value} min={low} max={high} step={step} choose={change} />
      <output class="min-w-[5ch] text-ink">{value}</output>
    </Field>
  );
}

const SHOW_TITLES: Record<Show, string> = { tile: "one tile", tiled: "2 × 2 tiles", detail: "detail where tiles meet" };
const PROSE = "mt-1 mb-2.5 max-w-[74ch] text-soft";
const TICK = "size-4.5 accent-accent";
const GREY = 0.25; // Pattern after the mask itself was shown

/** `base`: the server's address. */
interface LabProps { api: Api; base: string; shipped: readonly Choice[]; }

function Lab({ api, base, shipped }: LabProps) {
  const state = useMemo(() => signal(decodeState(location.hash)), []);
  // At once: what changes the address between the first reading and a later effect would be lost.
  useLayoutEffect(() => {
    const follow = () => {
      if (location.hash.slice(1) !== encodeState(state.value)) state.value = decodeState(location.hash);
    };
    window.addEventListener("hashchange", follow);
    return () => window.removeEventListener("hashchange", follow);
  }, [state]);
  const set = (part: Partial<LabState>) => {
    state.value = { ...state.value, ...part };
    history.replaceState(null, "", `#${encodeState(state.value)}`);
  };
  const { left, right, grey, show } = state.value;
  const first = useMask(api, left);
  const second = useMask(api, right);
  const beside = right === null ? null : second.loaded;
  const masks = useMemo(() => [first.loaded, beside].filter((mask): mask is LoadedMask => mask !== null), [first.loaded, beside]);
  return (
    <>
      <header>
        <h1 class="font-serif text-[clamp(26px,3.4vw,40px)]">Mask laboratory</h1>
        <p class={PROSE}>
          Foam shows where its saturation exceeds the mask's threshold, so each grey level has a pattern of its own.
        </p>
        <a class="inline-block py-2.5 text-accent underline" href="../">Back to the water</a>
      </header>
      <View state={state.value} set={set} />
      <div class={`grid gap-x-6.5 gap-y-2.5 phone:gap-x-3.5 ${right === null ? "" : "two grid-cols-2"}`}>
        <Side name="First mask" choice={left} mask={first} shipped={shipped} grey={grey} show={show} change={(choice) => set({ left: choice })} />
        {right !== null && (
          <Side name="Second mask" choice={right} mask={second} shipped={shipped} grey={grey} show={show} change={(choice) => set({ right: choice })} />
        )}
      </div>
      {masks.length > 0 && <Spectra masks={masks} grey={grey ?? GREY} />}
      {first.loaded && <TakeHome choice={left} loaded={first.loaded} base={base} />}
    </>
  );
}

function View({ state: { left, right, grey, show }, set }: { state: LabState; set: (part: Partial<LabState>) => void }) {
  return (
    <div class="flex flex-wrap content-start gap-x-5.5 gap-y-1 pt-1 pb-2.5" role="group" aria-label="View">
      <label class={FIELD}>
        <input type="checkbox" class={TICK} checked={grey === null} onChange={(event) => set({ grey: event.currentTarget.checked ? null : GREY })} />
        Mask itself
      </label>
      {grey !== null && <Slider label="Grey level" name="Grey level" value={grey} range={[0, 1]} step={1 / 64} change={(value) => set({ grey: value })} />}
      <Field label="Show">
        <Select class={PICK} label="Show" value={show} options={SHOWS.map((one) => [one, SHOW_TITLES[one]] as const)} choose={(chosen) => set({ show: chosen })} />
      </Field>
      <label class={FIELD}>
        <input
          type="checkbox"
          class={TICK}
          checked={right !== null}
          onChange={(event) => set({ right: event.currentTarget.checked ? (choiceText(left) === "clump" ? "vac-24" : "clump") : null })}
        />
        Two side by side
      </label>
    </div>
  );
}

interface SideProps {
  name: string;
  choice: MaskChoice;
  mask: MaskState;
  shipped: readonly Choice[];
  grey: number | null;
  show: Show;
  change: (choice: MaskChoice) => void;
}

function Side({ name, choice, mask: { loaded, busy, share, error }, shipped, grey, show, change }: SideProps) {
  return (
    // Rows that both sides share, so that their pictures stand beside each other.
    <section class="side row-span-3 grid min-w-0 grid-cols-1 grid-rows-subgrid" aria-label={name} aria-busy={busy}>
      <Controls name={name} choice={choice} shipped={shipped} info={loaded?.info ?? null} change={change} />
      {loaded && <Picture loaded={loaded} grey={grey} show={show} />}
      <p class={`status ${PROSE} ${error === null || busy ? "" : "text-error"}`} role="status">
        {busy ? "Making the mask…" : (error ?? (loaded ? description(loaded, grey) : ""))}
        {share !== null && <Progress label="Share of the mask that is made" share={share} />}
      </p>
    </section>
  );
}

function Picture({ loaded: { info, mask }, grey, show }: { loaded: LoadedMask; grey: number | null; show: Show }) {
  const paint = (canvas: HTMLCanvasElement) => {
    const [width, values] = [viewOf(mask.width, show).shown, shades(mask, grey, show)];
    paintPixels(canvas, width, values.length / width, (pixel) => {
      const value = values[pixel] ?? 0;
      return [value, value, value];
    });
  };
  return (
    <div class="picture aspect-square w-[min(100%,72vh)]">
      <Canvas class={`size-full rounded-sm object-contain ${show === "detail" ? "[image-rendering:pixelated]" : ""}`} label={`${info.title}, ${grey === null ? "the mask" : `pattern at grey ${grey}`}, ${SHOW_TITLES[show]}`} paint={paint} shows={[mask, grey, show]} />
    </div>
  );
}

function description({ info, mask }: LoadedMask, grey: number | null): string {
  const { sigma, width, height, seed }: MaskInfo["parameters"] = info.parameters;
  const foam = grey === null ? "" : `; foam on ${(100 * coverage(threshold(mask, grey))).toFixed(2)} %`;
  return `${info.family}, σ ${sigma}, ${width} × ${height} texels, seed ${seed}${foam}`;
}

const base = new URL("..", document.baseURI).href;
const api = new Api(base);
const root = byId("masklab");

try {
  const shipped = await api.choices("api/masks");
  render(<Lab api={api} base={base} shipped={shipped} />, root);
} catch (error) {
  render(<p role="alert">{messageOf(error)} Reload the page to try again.</p>, root);
}
