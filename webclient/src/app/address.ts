/** The address bar: keeps the link to the current view, the preset in the path and all else in the fragment. Requests for the preset of a link or a choice. */
import type { Api, Preset } from "../api";
import type { CameraControls } from "../camera/controls";
import { cameraFromScene } from "../camera/state";
import type { ChosenDisplay } from "../display/chosendisplay";
import { presetOfPath, waterUrl } from "../gallery/gallery";
import { diff } from "../scene/json";
import type { Store } from "../selection/selection";
import { decode, encode, frameSource, type LinkState } from "../selection/url";
import type { Surfaces } from "../surfaces/surfaces";
import { withoutTouches } from "../touch/touches";
import { copyText } from "../ui/dom";
import type { AccuracyTool } from "./accuracytool";
import type { Clock } from "./transport";

export class PresetLoader {
  private requests = 0;

  /** `busy`: called when a preset begins or ends to load. */
  constructor(private readonly api: Api, private readonly current: () => Preset, private readonly busy: (busy: boolean) => void) {}

  /** Resolves to null, and never rejects, if another preset was asked for meanwhile. */
  async load(name: string): Promise<Preset | null> {
    const request = ++this.requests;
    const isLatest = () => request === this.requests;
    const current = this.current();
    this.busy(name !== current.name);
    if (name === current.name) return current;
    try {
      const preset = await this.api.preset(name);
      return isLatest() ? preset : null;
    } catch (error) {
      if (isLatest()) throw error;
      return null;
    } finally {
      if (isLatest()) this.busy(false);
    }
  }
}

const DELAY = 400; // Delay between a change and the update of the address, ms

/** The link in an address. A preset in the fragment, as links had it once, comes before the path's; so does who draws. */
export function linkOf({ hash, pathname, search }: Pick<Location, "hash" | "pathname" | "search">): LinkState {
  const link = decode(hash);
  return { ...link, preset: link.preset ?? presetOfPath(pathname), draw: link.draw ?? frameSource(new URLSearchParams(search).get("draw")) };
}

export class Address {
  private timer = 0;
  private known = location.href; // The address that the page has read or written last

  constructor(
    private readonly store: Store,
    private readonly clock: Clock,
    private readonly controls: CameraControls,
    private readonly display: ChosenDisplay,
    private readonly accuracy: AccuracyTool,
    private readonly surfaces: Surfaces,
  ) {}

  /** `exact`: with time and camera even where they are the preset's own or time runs. */
  link(exact: boolean): LinkState {
    const { preset, scene, quality, auto, split } = this.store.now;
    const { time, speed, playing } = this.clock;
    const { camera } = this.controls;
    const isPresetCamera = JSON.stringify(camera) === JSON.stringify(cameraFromScene(preset.scene));
    return {
      preset: preset.name,
      ...withoutTouches(diff(preset.scene, scene), scene),
      quality: auto ? null : quality,
      time: exact || (!playing && time !== preset.time) ? time : null,
      paused: playing ? null : true,
      speed,
      camera: !exact && isPresetCamera ? null : camera,
      split,
      scale: this.display.current.fixed,
      draw: this.display.choice === "auto" ? null : this.display.choice,
      accuracy: this.accuracy.open ? true : null,
      surface: this.surfaces.open,
    };
  }

  scheduleUpdate(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.write(false), DELAY);
  }

  /** Copies the exact link to the clipboard; false if access is denied. */
  copy(): Promise<boolean> {
    this.write(true);
    return copyText(location.href);
  }

  /** Called with the link when the visitor goes to another address of the page: by hand, back or forward. */
  onVisit(listener: (link: LinkState) => void): void {
    const visited = () => {
      // Browsers differ in which of the two events a change of the fragment has.
      if (location.href === this.known) return;
      this.known = location.href;
      clearTimeout(this.timer);
      listener(linkOf(location));
    };
    window.addEventListener("hashchange", visited);
    window.addEventListener("popstate", visited);
  }

  /** Starts a new entry of the browser's history: the next preset's. The current one stays as it is. */
  startEntry(): void {
    this.write(false);
    history.pushState(null, "", location.href);
  }

  private write(exact: boolean): void {
    const { preset, ...rest } = this.link(exact);
    const fragment = encode({ ...rest, preset: null });
    const path = preset === null ? location.pathname : waterUrl(preset);
    history.replaceState(null, "", path + location.search + (fragment === "" ? "" : `#${fragment}`));
    this.known = location.href;
  }
}
