/** Controls of the figures. */
import type { Signal } from "@preact/signals";
import { useId } from "preact/hooks";

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

const digits = (step: number) => Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));

export function Slider({ label, value, min, max, step, log = false, unit = "" }: SliderProps) {
  const [to, from] = log ? [Math.log, Math.exp] : [(x: number) => x, (x: number) => x];
  const set = (place: number) => (value.value = Number(from(place).toFixed(digits(step))));
  const text = `${value.value.toFixed(digits(step))}${unit}`;
  return (
    <label class="slider">
      <span>{label}</span>
      <input
        type="range"
        min={to(min)}
        max={to(max)}
        step={log ? "any" : step}
        value={to(value.value)}
        aria-valuetext={text}
        onInput={(event) => set(event.currentTarget.valueAsNumber)}
      />
      <output>{text}</output>
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
    <fieldset class="choice">
      <legend>{label}</legend>
      <div>
        {options.map(([option, title]) => (
          <label key={option}>
            <input type="radio" name={name} checked={value.value === option} onChange={() => (value.value = option)} />
            <span>{title}</span>
          </label>
        ))}
      </div>
    </fieldset>
  );
}

export function Select<T extends string>({ label, value, options }: ChoiceProps<T>) {
  return (
    <label class="select">
      <span>{label}</span>
      <select value={value.value} onChange={(event) => (value.value = event.currentTarget.value as T)}>
        {options.map(([option, title]) => (
          <option key={option} value={option}>
            {title}
          </option>
        ))}
      </select>
    </label>
  );
}

export function PlayButton({ playing }: { playing: Signal<boolean> }) {
  return (
    <button type="button" class="play" aria-pressed={playing.value} onClick={() => (playing.value = !playing.value)}>
      <svg viewBox="0 0 24 24" aria-hidden="true">
        <path d={playing.value ? "M8.500 5.500v13M15.500 5.500v13" : "M8 5.500v13l10.500-6.500z"} />
      </svg>
      {playing.value ? "Pause" : "Play"}
    </button>
  );
}
