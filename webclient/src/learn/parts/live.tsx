/** Controls of the figures, and what runs a figure while it is in view. */
import { effect, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import { type ComponentChild, render } from "preact";
import { useId } from "preact/hooks";
import { type Api, messageOf } from "../../api";
import { Select as DropDown } from "../../ui/controls";
import { element, prefersReducedMotion } from "../../ui/dom";

interface SliderProps {
  label: string;
  value: Signal<number>;
  min: number;
  max: number;
  step: number;
  log?: boolean; // Equal steps are equal ratios
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

interface ChoiceProps<T extends string> { label: string; value: Signal<T>; options: readonly (readonly [T, string])[]; }

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

export interface LiveFigure {
  controls?: ComponentChild; // After the play button, which figures that move have
  inputs?: readonly ReadonlySignal<unknown>[]; // Values whose changes ask for a new picture
  resize(width: number): void; // width: of the figure's plate, px
  /** time: s; seconds: by which it moved since the last frame, 0 if it stands. Absent where nothing moves by itself. */
  draw?(time: number, seconds: number): void;
}

export interface FigureContext {
  api: Api;
  plate: HTMLElement; // Where the picture goes
  /** Asks for a new picture of a figure that stands. */
  redraw: () => void;
}

export type MakeFigure = (context: FigureContext) => LiveFigure | Promise<LiveFigure>;

const LONGEST = 0.1; // Longest step of time between two frames, s: a hidden figure stands still

/** Calls back when an element has another width than it is known to have, px; not while it has none. */
export function onWidthChange(observed: HTMLElement, known: number, changed: (width: number) => void): void {
  let width = known;
  new ResizeObserver(() => {
    if (observed.clientWidth === width || observed.clientWidth === 0) return;
    width = observed.clientWidth;
    changed(width);
  }).observe(observed);
}

export class Runner {
  readonly playing = signal(!prefersReducedMotion());
  private figure: LiveFigure | null = null;
  private loading = false;
  private inView = false;
  private dirty = true;
  private scheduled = false;
  private last = 0;

  constructor(private readonly root: HTMLElement, private readonly api: Api, private readonly make: MakeFigure, private time: number) {}

  /** Loads the figure when it is near, and runs it while it is seen. */
  watch(): void {
    const near = new IntersectionObserver(
      (entries) => {
        if (!entries.some(({ isIntersecting }) => isIntersecting)) return;
        near.disconnect();
        void this.load();
      },
      { rootMargin: "100% 0px" },
    );
    near.observe(this.root);
    new IntersectionObserver((entries) => {
      this.inView = entries.at(-1)?.isIntersecting ?? false;
      this.schedule();
    }).observe(this.root);
  }

  async load(): Promise<void> {
    if (this.loading) return;
    this.loading = true;
    const find = (selector: string) => this.root.querySelector<HTMLElement>(selector) ?? this.root;
    const [plate, controls] = [find(".plate"), find(".controls")];
    const still = plate.querySelector("img");
    const stage = element("div", { class: "stage" });
    try {
      const redraw = () => {
        this.dirty = true;
        this.schedule();
      };
      const figure = await this.make({ api: this.api, plate: stage, redraw });
      render(
        <>
          {figure.draw && <PlayButton playing={this.playing} />}
          {figure.controls}
        </>,
        controls,
      );
      figure.inputs?.forEach((input) => input.subscribe(redraw));
      const width = plate.clientWidth;
      figure.resize(width);
      figure.draw?.(this.time, 0);
      this.figure = figure;
      still?.replaceWith(stage);
      if (still === null) plate.append(stage);
      this.root.dataset["live"] = "true";
      onWidthChange(plate, width, (fitting) => {
        figure.resize(fitting);
        redraw();
      });
      effect(() => {
        if (this.playing.value) this.schedule();
      });
    } catch (error) {
      // The still stays.
      this.root.dataset["live"] = "false";
      controls.textContent = `This figure stands still: ${messageOf(error)}`;
    }
  }

  private schedule(): void {
    if (this.scheduled || !this.inView || this.figure === null || !(this.playing.peek() || this.dirty)) return;
    this.scheduled = true;
    requestAnimationFrame((now) => this.tick(now));
  }

  private tick(now: number): void {
    this.scheduled = false;
    const seconds = this.playing.peek() ? Math.min((now - this.last) / 1000, LONGEST) : 0;
    this.last = now;
    if (!this.inView || this.figure === null) return;
    this.time += Math.max(seconds, 0);
    this.dirty = false;
    this.figure.draw?.(this.time, Math.max(seconds, 0));
    this.root.dataset["time"] = this.time.toFixed(3);
    this.schedule();
  }
}
