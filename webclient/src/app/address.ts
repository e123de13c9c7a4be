/** The address bar: keeps the link to the current view in the fragment. */
import type { CameraControls } from "../camera/controls";
import { cameraFromScene } from "../camera/state";
import { diff } from "../scene/json";
import type { AccuracyTool } from "./accuracytool";
import type { Clock } from "./clock";
import type { Store } from "./store";
import { encode, type LinkState } from "./url";
import type { Viewport } from "./viewport";

/** Delay between a change and the update of the address, ms. */
const DELAY = 400;

export class Address {
  private timer = 0;

  constructor(
    private readonly store: Store,
    private readonly clock: Clock,
    private readonly controls: CameraControls,
    private readonly viewport: Viewport,
    private readonly accuracy: AccuracyTool,
  ) {}

  /** `exact`: with time and camera even where they are the preset's own or time runs. */
  link(exact: boolean): LinkState {
    const { preset, scene, quality, auto, split } = this.store.now;
    const { time, speed, playing } = this.clock;
    const { camera } = this.controls;
    const isPresetCamera = JSON.stringify(camera) === JSON.stringify(cameraFromScene(preset.scene));
    return {
      preset: preset.name,
      changes: diff(preset.scene, scene),
      quality: auto ? null : quality,
      time: exact || (!playing && time !== preset.time) ? time : null,
      paused: playing ? null : true,
      speed,
      camera: !exact && isPresetCamera ? null : camera,
      split,
      scale: this.viewport.fixed,
      accuracy: this.accuracy.open ? true : null,
    };
  }

  scheduleUpdate(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.write(false), DELAY);
  }

  /** Copies the exact link to the clipboard; rejects if access is denied. */
  async copy(): Promise<void> {
    this.write(true);
    await navigator.clipboard.writeText(location.href);
  }

  private write(exact: boolean): void {
    history.replaceState(null, "", `#${encode(this.link(exact))}`);
  }
}
