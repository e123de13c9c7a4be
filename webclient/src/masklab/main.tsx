/** The mask laboratory, a page of its own: one mask or two, their patterns, spectra, files and code. */
import "../style.css";
import { signal } from "@preact/signals";
import { render } from "preact";
import { useEffect, useMemo } from "preact/hooks";
import { Api, type Choice, messageOf } from "../api";
import { Canvas, paintPixels } from "../charts/parts";
import { Progress, Select } from "../ui/controls";
import { byId } from "../ui/dom";
import { choiceText, coverage, decodeState, encodeState, type LabState, type LoadedMask, type MaskChoice, type MaskInfo, type MaskState, shades, type Show, SHOWS, threshold, useMask, viewOf } from "./choice";
import { Controls, Field, FIELD, PICK, Slider } from "./controls";
import { Spectra } from "./spectra";
import { TakeHome } from "./takehome";

const SHOW_TITLES: Record<Show, string> = { tile: "one tile", tiled: "2 × 2 tiles", detail: "detail where tiles meet" };
const PROSE = "mt-1 mb-2.5 max-w-[74ch] text-soft";
const TICK = "size-4.5 accent-accent";
const GREY = 0.25; // Pattern after the mask itself was shown

interface LabProps {
  api: Api;
  base: string; // The server's address
  shipped: readonly Choice[];
}

function Lab({ api, base, shipped }: LabProps) {
  const state = useMemo(() => signal(decodeState(location.hash)), []);
  useEffect(() => {
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
