/** Quality, frame time, frame rate and size of the picture. */
import type { FrameTiming } from "../app/display";
import { element } from "./dom";

const CLOCKS = { gpu: "GPU timer query", fence: "until rendering is done", server: "from request to decoded picture" };

export class FrameStats {
  readonly root = element("output", { class: "frame-stats h-4.5 w-[42ch] flex-none overflow-hidden text-right text-small/[18px] whitespace-nowrap text-soft tabular-nums will-change-transform contain-strict phone:order-9 phone:w-full phone:text-center phone:text-tiny/[18px] under-sheet:hidden" });

  /** `auto`: the page selected the quality. */
  show({ frame, clock, fps, width, height, scale }: FrameTiming, playing: boolean, quality: string, auto: boolean): void {
    const time = frame === null ? null : `${frame.toFixed(frame < 10 ? 1 : 0)} ms`;
    const size = `${width} × ${height}${scale < 1 ? ` (${Math.round(scale * 100)} %)` : ""}`;
    const shortQuality = quality.length > 12 ? null : quality;
    const text = [clock === "server" ? "server" : null, shortQuality, time, playing ? `${fps} fps` : "paused", size].filter(Boolean).join(" · ");
    // Unchanged text is not set again: the browser would repaint it.
    if (this.root.textContent !== text) this.root.textContent = text;
    const title =
      `Quality${auto ? " (automatic)" : ""}: ${quality}. Frame time: ${CLOCKS[clock]}.` +
      (scale < 1 ? " Resolution reduced while moving." : "");
    if (this.root.title !== title) this.root.title = title;
  }
}
