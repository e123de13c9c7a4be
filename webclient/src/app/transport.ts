/** The clock, and the bar with its controls: play and pause, a scrubber, the time, the speed, and what frames take. */
import type { FrameSource, FrameTiming } from "../display/display";
import { button, dropDown, element, hasModifier, isTyping } from "../ui/dom";
import { icon } from "../ui/icons";

const LONGEST_GAP = 0.4; // s: a frame at 4 a second, with time for one that comes late

export class Clock {
  time = 0;
  speed = 1;
  private isPlaying = false;
  private readonly listeners = new Set<() => void>();

  get playing(): boolean { return this.isPlaying; }

  set playing(playing: boolean) {
    this.isPlaying = playing;
    this.notify();
  }

  /** Advances by `seconds` of real time; longer gaps, as in a hidden tab, are cut: the water keeps its pace at 4 frames a second. */
  advance(seconds: number): void {
    if (this.isPlaying) this.time += Math.min(seconds, LONGEST_GAP) * this.speed;
  }

  seek(time: number): void {
    if (!Number.isFinite(time)) return;
    this.time = Math.min(1e9, Math.max(-1e9, time));
    this.notify();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.notify();
  }

  /** Called on play, pause, seek and a change of speed; not on every frame. */
  onChange(listener: () => void): void {
    this.listeners.add(listener);
  }

  private notify(): void {
    for (const listener of this.listeners) listener();
  }
}

const FRAME = 1 / 60; // One frame, s: the step of the keys , and 

const WINDOW = 60; // Length of the scrubber, s: it covers the current minute, since time is unbounded
/** Drawn by backgrounds, which forced colours take away. */
const LINE = "pointer-events-none absolute inset-x-[7px] top-[21px] h-0.5 rounded-[1px] forced-colors:bg-[CanvasText] forced-colors:forced-color-adjust-none";
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

export class Transport {
  private readonly play = button({ class: "round" }, () => (this.clock.playing = !this.clock.playing));
  /** Transparent, over a line and a dot that are moved without repainting. */
  private readonly scrub = element("input", { type: "range", class: "w-full opacity-0", min: 0, max: WINDOW, step: "any", "aria-label": "Time within the minute" });
  private readonly elapsed = element("i", { class: `${LINE} origin-left bg-ink will-change-transform` });
  /** As wide as the track, so that translateX in percent is a share of the track. */
  private readonly position = element("i", { class: "pointer-events-none absolute inset-x-[7px] top-[21px] h-0 will-change-transform before:absolute before:-top-1.5 before:-left-[7px] before:size-3.5 before:rounded-full before:bg-ink forced-colors:before:forced-color-adjust-none forced-colors:before:bg-[CanvasText]" });
  private readonly timeInput = element("input", { type: "text", inputmode: "decimal", class: "h-11 w-[8.5ch] text-right tabular-nums will-change-transform contain-strict phone:w-[7ch]", "aria-label": "Time in seconds", title: "Time in seconds; the keys , and . step by a frame of 1/60 s" });
  private readonly speed = dropDown({ class: "pick field-sizing-content", "aria-label": "Speed", title: "Speed" }, (speed) => this.clock.setSpeed(Number(speed)));
  private scrubbing = false;

  constructor(container: HTMLElement, private readonly clock: Clock, startTime: () => number, readout: HTMLElement) {
    const reset = button({ class: "plain", title: "Reset time", "aria-label": "Reset time" }, () => clock.seek(startTime()), icon("reset"));
    this.speed.append(...SPEEDS.map((s) => element("option", { value: s }, `${s}×`)));
    const unit = element("label", { class: "flex items-center gap-1 text-soft" }, this.timeInput, element("span", {}, "s"));
    const scrub = element("div", { class: "relative mr-2.5 ml-1.5 h-11 min-w-15 flex-1 contain-layout contain-style has-focus-visible:rounded-md has-focus-visible:outline-2 has-focus-visible:outline-accent phone:mx-1" }, element("i", { class: `${LINE} bg-track` }), this.elapsed, this.position, this.scrub);
    container.append(this.play, reset, scrub, unit, this.speed, readout);

    this.scrub.addEventListener("input", () => {
      this.scrubbing = true;
      clock.seek(Math.floor(clock.time / WINDOW) * WINDOW + Number(this.scrub.value) * (1 - 1e-9));
    });
    this.scrub.addEventListener("change", () => (this.scrubbing = false));
    this.timeInput.addEventListener("change", () => {
      clock.seek(Number(this.timeInput.value.replace(",", ".")));
      this.timeInput.blur();
      this.update();
    });
    // The exact time, which the field rounds otherwise; selected, for the next one to be typed over it.
    this.timeInput.addEventListener("focus", () => {
      this.timeInput.value = String(clock.time);
      this.timeInput.select();
    });
    this.timeInput.addEventListener("blur", () => this.update());
    document.addEventListener("keydown", this.keyDown);
    clock.onChange(() => this.showState());
    this.showState();
  }

  private readonly keyDown = (event: KeyboardEvent): void => {
    if (hasModifier(event)) return;
    const frames = { ",": -1, ".": 1 }[event.key];
    // Keys of what has the focus.
    const pressed = event.target instanceof HTMLElement && event.target.matches("input, select, button, textarea, a, summary, [role=slider]");
    if (frames !== undefined && !isTyping(event)) {
      this.clock.playing = false;
      this.clock.seek(frameAfter(this.clock.time, frames));
    } else if (event.code === "Space" && !pressed) {
      event.preventDefault();
      this.clock.playing = !this.clock.playing;
    }
  };

  movePosition(): void {
    const share = this.secondsInMinute() / WINDOW;
    this.elapsed.style.transform = `scaleX(${share})`;
    this.position.style.transform = `translateX(${100 * share}%)`;
  }

  update(): void {
    const { time, playing } = this.clock;
    if (!this.scrubbing) this.scrub.value = String(this.secondsInMinute());
    if (document.activeElement !== this.timeInput) this.timeInput.value = time.toFixed(playing ? 1 : 2);
    this.movePosition();
  }

  private secondsInMinute(): number {
    const { time } = this.clock;
    return time - Math.floor(time / WINDOW) * WINDOW;
  }

  private showState(): void {
    const { playing, speed } = this.clock;
    this.play.replaceChildren(icon(playing ? "pause" : "play"));
    this.play.setAttribute("aria-label", playing ? "Pause" : "Play");
    this.play.title = playing ? "Pause (space)" : "Play (space)";
    if (!SPEEDS.includes(speed) && ![...this.speed.options].some((o) => Number(o.value) === speed)) {
      this.speed.append(element("option", { value: speed }, `${speed}×`));
    }
    this.speed.value = String(speed);
    this.update();
  }
}

/** The start of the next (1) or previous (-1) frame, s: from between two frames, the nearer one in that direction. */
export function frameAfter(time: number, frames: number): number {
  const exact = time / FRAME;
  const nearest = Math.round(exact);
  // A multiple of 1/60 is seldom a float64.
  const start = Math.abs(exact - nearest) < 1e-4 ? nearest : frames > 0 ? Math.floor(exact) : Math.ceil(exact);
  return (start + frames) / 60;
}

const SLOW_MOTION = 2.5; // Frames a second below which the water falls behind the clock

interface FrameState extends FrameTiming {
  source: FrameSource;
  why: string; // Who draws, and why
  stalled: boolean;
  playing: boolean;
  quality: string;
  auto: boolean; // Whether the page selected the quality
}

export class FrameStats {
  readonly root = element("output", { class: "frame-stats h-4.5 w-[42ch] flex-none overflow-hidden text-right text-small/[18px] whitespace-nowrap text-soft tabular-nums will-change-transform contain-strict phone:order-9 phone:w-full phone:text-center phone:text-tiny/[18px] under-sheet:hidden" });

  show({ frame, fps, width, height, scale, frames, source, why, stalled, playing, quality, auto }: FrameState): void {
    const time = frame === null ? null : `${Math.max(0.1, frame).toFixed(frame < 10 ? 1 : 0)} ms`;
    const size = `${width} × ${height}${scale < 1 ? ` (${Math.round(scale * 100)} %)` : ""}`;
    const shortQuality = quality.length > 12 ? null : quality;
    const rate = stalled ? "still" : playing ? `${fps} fps` : "paused";
    const slow = playing && !stalled && frames > 1 && fps < SLOW_MOTION ? "slow motion" : null;
    const text = frames === 0 ? "" : [source === "server" ? "server" : null, shortQuality, time, rate, slow, size].filter(Boolean).join(" · ");
    // Unchanged text is not set again: the browser would repaint it.
    if (this.root.textContent !== text) this.root.textContent = text;
    const title = `${why} Quality${auto ? " (automatic)" : ""}: ${quality}.` + (scale < 1 ? " Resolution reduced while moving." : "");
    if (this.root.title !== title) this.root.title = title;
  }
}
