/** Quality, frame time, frame rate and size of the picture. */
import type { FrameSource, FrameTiming } from "../display/display";
import { element } from "./dom";

/** Frames a second below which the water falls behind the clock. */
const SLOW_MOTION = 2.5;

interface FrameState extends FrameTiming {
  source: FrameSource;
  /** Who draws, and why. */
  why: string;
  stalled: boolean;
  playing: boolean;
  quality: string;
  /** Whether the page selected the quality. */
  auto: boolean;
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
