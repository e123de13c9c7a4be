/** Controls of the figures. */
import type { Signal } from "@preact/signals";
import { useId } from "preact/hooks";
import { Select as DropDown } from "../../ui/controls";

interface SliderProps {
  label: string;
  value: Signal<number>;
  min: number;
  max: number;
  step: number;
  /** Equal steps are equal ratios. */
  log?: boolean;
  unit?: string;
}

const FIELD = "grid max-w-[300px] min-w-0 flex-[1_1_190px] phone:max-w-none phone:basis-full laboratory:max-w-none laboratory:flex-none";

const digits = (step: number) => Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));

export function Slider({ label, value, min, max, step, log = false, unit = "" }: SliderProps) {
  const [to, from] = log ? [Math.log, Math.exp] : [(x: number) => x, (x: number) => x];
  const set = (place: number) => (value.value = Number(from(place).toFixed(digits(step))));
  const text = `${value.value.toFixed(digits(step))}${unit}`;
  return (
    <label class={`${FIELD} grid-cols-[1fr_auto]`}>
      <span>{label}</span>
      <input
        type="range"
        class="col-[1/3] row-2 -mt-1 min-h-11 w-full accent-accent"
        min={to(min)}
        max={to(max)}
        step={log ? "any" : step}
        value={to(value.value)}
        aria-valuetext={text}
        onInput={(event) => set(event.currentTarget.valueAsNumber)}
      />
      <output class="col-2 row-1 text-soft tabular-nums">{text}</output>
    </label>
  );
}

interface ChoiceProps<T extends string> {
  label: string;
  value: Signal<T>;
  options: readonly (readonly [T, string])[];
}

/** Buttons of which one is chosen. */
export function Choice<T extends string>({ label, value, options }: ChoiceProps<T>) {
  const name = useId();
  return (
    <fieldset class="min-w-0">
      <legend>{label}</legend>
      <div class="flex flex-wrap gap-1">
        {options.map(([option, title]) => (
          <label key={option} class="relative">
            <input type="radio" class="peer absolute inset-0 size-full cursor-pointer opacity-0" name={name} checked={value.value === option} onChange={() => (value.value = option)} />
            <span class="control inline-flex items-center peer-checked:border-accent peer-checked:text-accent peer-focus-visible:outline-2 peer-focus-visible:outline-offset-2 peer-focus-visible:outline-accent">{title}</span>
          </label>
        ))}
      </div>
    </fieldset>
  );
}

export function Select<T extends string>({ label, value, options }: ChoiceProps<T>) {
  return (
    <label class={FIELD}>
      <span>{label}</span>
      <DropDown class="control w-full min-w-0 bg-ground" label={label} value={value.value} options={options} choose={(chosen) => (value.value = chosen)} />
    </label>
  );
}

export function PlayButton({ playing }: { playing: Signal<boolean> }) {
  return (
    <button type="button" class="control inline-flex min-w-24 items-center gap-1.5" aria-pressed={playing.value} onClick={() => (playing.value = !playing.value)}>
      <svg class="w-5 fill-none stroke-current stroke-[1.7] [stroke-linejoin:round]" viewBox="0 0 24 24" aria-hidden="true">
        <path d={playing.value ? "M8.500 5.500v13M15.500 5.500v13" : "M8 5.500v13l10.500-6.500z"} />
      </svg>
      {playing.value ? "Pause" : "Play"}
    </button>
  );
}
