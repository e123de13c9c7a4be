/** Choice of one mask: shipped, or a family with its parameters. */
import type { ComponentChildren } from "preact";
import { Select } from "../ui/controls";
import { ASPECT_RANGE, type CustomMask, FAMILIES, type MaskChoice, type MaskInfo, SEED_RANGE, SIDE_RANGE, SIGMA_RANGE } from "./choice";

const TITLES: Record<(typeof FAMILIES)[number], string> = {
  vac: "void and cluster",
  blur: "filtered noise",
  clump: "clumps",
  bubble: "bubbles",
  mix: "clustered bubbles",
  lace: "lace",
};
export const FIELD = "flex min-h-11 min-w-0 items-center gap-2.5 text-soft";
/** Below its name where two masks share a phone. */
export const PICK = "min-h-11 max-w-full min-w-0 rounded-md bg-hover px-2.5 text-ink phone:flex-1 paired:w-full paired:flex-[1_1_100%]";
const CUSTOM = ":custom";
const FIRST: CustomMask = { family: "vac", sigma: 3, width: 128, height: 128, seed: 1, aspect: 1, age: 0 };

interface ControlsProps {
  name: string;
  choice: MaskChoice;
  shipped: readonly { name: string; title: string }[];
  info: MaskInfo | null; // What is shown now: the start of own parameters
  change: (choice: MaskChoice) => void;
}

export function Controls({ name, choice, shipped, info, change }: ControlsProps) {
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
export function Field({ label, children }: { label: string; children: ComponentChildren }) {
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

export function Slider({ label, name, value, range: [low, high], step, change }: NumberProps & { step: number }) {
  return (
    <Field label={label}>
      <input
        type="range"
        class="w-[150px] paired:w-full paired:flex-[1_1_100%]"
        aria-label={name}
        min={low}
        max={high}
        step={step}
        value={value}
        style={{ "--share": `${(100 * (value - low)) / (high - low)}%` }}
        onInput={(event) => change(event.currentTarget.valueAsNumber)}
      />
      <output class="min-w-[5ch] text-ink">{value}</output>
    </Field>
  );
}
