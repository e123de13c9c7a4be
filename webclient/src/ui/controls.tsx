/** Controls of Preact views. */

/** A bar of what is done: `share` 0 to 1, or null while that is not known. */
export function Progress({ label, share, class: more }: { label: string; share: number | null; class?: string }) {
  const bar = "h-[3px] w-full appearance-none bg-track [&::-moz-progress-bar]:bg-accent [&::-webkit-progress-bar]:bg-transparent [&::-webkit-progress-value]:bg-accent";
  return <progress class={`${more ?? ""} ${bar}`} max={1} aria-label={label} {...(share === null ? {} : { value: share })} />;
}

interface RangeProps extends Record<"value" | "min" | "max" | "step", number> {
  class: string;
  label: string;
  text?: string; // The value in words
  choose: (value: number) => void;
}

/** A slider, with the share of its range below the value as `--share`. */
export function RangeInput({ class: classes, label, text, value, min, max, step, choose }: RangeProps) {
  const input = { class: classes, "aria-label": label, "aria-valuetext": text, style: { "--share": `${(100 * (value - min)) / (max - min)}%` } };
  return <input type="range" {...input} min={min} max={max} step={step} value={value} onInput={(event) => choose(event.currentTarget.valueAsNumber)} />;
}

interface SelectProps<T extends string> {
  class: string;
  label: string;
  value: T;
  options: readonly (readonly [T, string])[]; // Values and titles
  choose: (value: T) => void;
}

/** A drop-down list. */
export function Select<T extends string>({ class: classes, label, value, options, choose }: SelectProps<T>) {
  return (
    <select class={classes} aria-label={label} value={value} onChange={(event) => choose(event.currentTarget.value as T)}>
      {options.map(([option, title]) => <option value={option} key={option}>{title}</option>)}
    </select>
  );
}
