/** How long a frame takes, and at which size it is drawn. */
import type { Timing } from "../app/stage";
import { element } from "./dom";

export class Readout {
  readonly root = element("output", { class: "readout" });

  show({ frame, measuredByGpu, fps, width, height, scale }: Timing, playing: boolean): void {
    const time = frame === null ? null : `${frame.toFixed(frame < 10 ? 1 : 0)} ms`;
    const size = `${width} × ${height}${scale < 1 ? ` (${Math.round(scale * 100)} %)` : ""}`;
    this.root.textContent = [time, playing ? `${fps} fps` : "still", size].filter(Boolean).join(" · ");
    this.root.title =
      (measuredByGpu ? "Time a frame takes on the GPU, by its own clock" : "Time from one frame to the next") +
      (scale < 1 ? "; drawn smaller to keep moving, sharpened at rest" : "");
  }
}
