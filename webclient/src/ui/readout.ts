/** What is drawn: at which quality, how long a frame takes, how many there are, at which size. */
import type { Timing } from "../app/stage";
import { element } from "./dom";

export class Readout {
  readonly root = element("output", { class: "readout" });

  /** `auto`: the page chose the quality. */
  show({ frame, measuredByGpu, fps, width, height, scale }: Timing, playing: boolean, quality: string, auto: boolean): void {
    const time = frame === null ? null : `${frame.toFixed(frame < 10 ? 1 : 0)} ms`;
    const size = `${width} × ${height}${scale < 1 ? ` (${Math.round(scale * 100)} %)` : ""}`;
    const tier = quality.length > 12 ? null : quality;
    const text = [tier, time, playing ? `${fps} fps` : "still", size].filter(Boolean).join(" · ");
    // Set to what it is, text is painted again for nothing.
    if (this.root.textContent !== text) this.root.textContent = text;
    const title =
      `${auto ? "Quality chosen for this machine" : "Quality"}: ${quality}. ` +
      (measuredByGpu ? "Time of a frame on the GPU, by its own clock" : "Time that a frame of water takes, the page around it left out") +
      (scale < 1 ? "; drawn smaller to keep moving, sharpened at rest" : "");
    if (this.root.title !== title) this.root.title = title;
  }
}
