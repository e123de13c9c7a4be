/**
 * Playback controls: play and pause, a scrubber, the time and the speed.
 *
 * `movePosition` is for every frame: it sets transforms, which repaints nothing. `update` repaints, a few times a second.
 */
import type { Clock } from "../app/clock";
import { element } from "./dom";
import { icon } from "./icons";

/** Length of the scrubber, s: it covers the current minute, since time is unbounded. */
const WINDOW = 60;
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

export class Transport {
  private readonly play = element("button", { type: "button", class: "round" });
  private readonly scrub = element("input", { type: "range", min: 0, max: WINDOW, step: "any", "aria-label": "Time within the minute" });
  private readonly elapsed = element("i", { class: "elapsed" });
  private readonly position = element("i", { class: "position" });
  private readonly timeInput = element("input", { type: "text", inputmode: "decimal", class: "time-input", "aria-label": "Time in seconds", title: "Time in seconds" });
  private readonly speed = element("select", { "aria-label": "Speed", title: "Speed" });
  private scrubbing = false;

  constructor(
    container: HTMLElement,
    private readonly clock: Clock,
    startTime: () => number,
    readout: HTMLElement,
  ) {
    const reset = element("button", { type: "button", class: "plain", title: "Reset time", "aria-label": "Reset time" }, icon("reset"));
    this.speed.append(...SPEEDS.map((s) => element("option", { value: s }, `${s}×`)));
    const unit = element("label", { class: "time" }, this.timeInput, element("span", {}, "s"));
    const scrub = element("div", { class: "scrub" }, element("i"), this.elapsed, this.position, this.scrub);
    container.append(this.play, reset, scrub, unit, this.speed, readout);

    this.play.addEventListener("click", () => (clock.playing = !clock.playing));
    reset.addEventListener("click", () => clock.seek(startTime()));
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
    this.speed.addEventListener("change", () => clock.setSpeed(Number(this.speed.value)));
    document.addEventListener("keydown", (event) => {
      const inControl = event.target instanceof HTMLElement && event.target.matches("input, select, button, textarea, [role=slider]");
      if (event.code !== "Space" || inControl) return;
      event.preventDefault();
      clock.playing = !clock.playing;
    });
    clock.onChange(() => this.showState());
    this.showState();
  }

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
