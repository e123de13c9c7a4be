/** Runs a figure while it is in view. */
import { effect, type ReadonlySignal, signal } from "@preact/signals";
import { type ComponentChild, render } from "preact";
import { type Api, messageOf } from "../../api";
import { element, prefersReducedMotion } from "../../ui/dom";
import { PlayButton } from "./controls";

export interface LiveFigure {
  /** After the play button, which figures that move have. */
  controls?: ComponentChild;
  /** Values whose changes ask for a new picture. */
  inputs?: readonly ReadonlySignal<unknown>[];
  /** width: of the figure's plate, px. */
  resize(width: number): void;
  /** time: s; seconds: by which it moved since the last frame, 0 if it stands. Absent where nothing moves by itself. */
  draw?(time: number, seconds: number): void;
}

export interface FigureContext {
  api: Api;
  /** Where the picture goes. */
  plate: HTMLElement;
  /** Asks for a new picture of a figure that stands. */
  redraw: () => void;
}

export type MakeFigure = (context: FigureContext) => LiveFigure | Promise<LiveFigure>;

/** Longest step of time between two frames, s: a hidden figure stands still. */
const LONGEST = 0.1;

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

  constructor(
    private readonly root: HTMLElement,
    private readonly api: Api,
    private readonly make: () => Promise<MakeFigure>,
    private time: number,
  ) {}

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
      const make = await this.make();
      const redraw = () => {
        this.dirty = true;
        this.schedule();
      };
      const figure = await make({ api: this.api, plate: stage, redraw });
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
