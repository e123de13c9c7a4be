/**
 * Time: play and pause, a minute to scrub through, speed, the moment as a number.
 *
 * While time runs, `move` shifts the line and the dot, which paints nothing; `update`, which paints the moment anew, is for
 * a few times a second.
 */
import type { Clock } from "../app/clock";
import { element } from "./dom";
import { icon } from "./icons";

/** Length of the scrubber, s. Time itself has no end: the scrubber shows the minute that it is in. */
const WINDOW = 60;
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

export class Transport {
  private readonly play = element("button", { type: "button", class: "round" });
  private readonly scrub = element("input", { type: "range", min: 0, max: WINDOW, step: "any", "aria-label": "Time within the minute" });
  private readonly past = element("i", { class: "past" });
  private readonly at = element("i", { class: "at" });
  private readonly moment = element("input", { type: "text", inputmode: "decimal", class: "moment", "aria-label": "Time in seconds", title: "Time in seconds" });
  private readonly speed = element("select", { "aria-label": "Speed", title: "Speed" });
  private scrubbing = false;

  constructor(
    container: HTMLElement,
    private readonly clock: Clock,
    home: () => number,
    readout: HTMLElement,
  ) {
    const reset = element("button", { type: "button", class: "plain", title: "Back to where this sea starts", "aria-label": "Reset the time" }, icon("reset"));
    this.speed.append(...SPEEDS.map((s) => element("option", { value: s }, `${s}×`)));
    const unit = element("label", { class: "time" }, this.moment, element("span", {}, "s"));
    const scrub = element("div", { class: "scrub" }, element("i"), this.past, this.at, this.scrub);
    container.append(this.play, reset, scrub, unit, this.speed, readout);

    this.play.addEventListener("click", () => (clock.playing = !clock.playing));
    reset.addEventListener("click", () => clock.jump(home()));
    this.scrub.addEventListener("input", () => {
      this.scrubbing = true;
      clock.jump(Math.floor(clock.time / WINDOW) * WINDOW + Number(this.scrub.value) * (1 - 1e-9));
    });
    this.scrub.addEventListener("change", () => (this.scrubbing = false));
    this.moment.addEventListener("change", () => {
      clock.jump(Number(this.moment.value.replace(",", ".")));
      this.moment.blur();
      this.update();
    });
    this.speed.addEventListener("change", () => clock.setSpeed(Number(this.speed.value)));
    document.addEventListener("keydown", (event) => {
      const busy = event.target instanceof HTMLElement && event.target.matches("input, select, button, textarea, [role=slider]");
      if (event.code !== "Space" || busy) return;
      event.preventDefault();
      clock.playing = !clock.playing;
    });
    clock.onChange(() => this.state());
    this.state();
  }

  /** Puts the dot where time is. */
  move(): void {
    const share = this.within() / WINDOW;
    this.past.style.transform = `scaleX(${share})`;
    this.at.style.transform = `translateX(${100 * share}%)`;
  }

  /** Shows the moment: tenths while time runs, for nobody can read more. */
  update(): void {
    const { time, playing } = this.clock;
    if (!this.scrubbing) this.scrub.value = String(this.within());
    if (document.activeElement !== this.moment) this.moment.value = time.toFixed(playing ? 1 : 2);
    this.move();
  }

  /** Seconds into the minute. */
  private within(): number {
    const { time } = this.clock;
    return time - Math.floor(time / WINDOW) * WINDOW;
  }

  private state(): void {
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
