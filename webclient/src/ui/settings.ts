/** The panel: quality, the view, the scene's fields, what runs and why. On a phone it is a sheet from below. */
import type { Controls, Mode } from "../camera/controls";
import { element, fillSelect } from "./dom";
import { icon } from "./icons";
import { qualityTitle } from "../app/quality";
import type { Notes } from "./notes";

export interface SettingsEvents {
  /** null: what the machine draws best in time. */
  quality(name: string | null): void;
  /** A share of the full resolution; null: as sharp as moves well. */
  scale(scale: number | null): void;
  /** Puts the scene, the camera and the time back to the preset's own. */
  reset(): void;
  serverFrame(): void;
}

const DEGREES = 180 / Math.PI;
const AUTO = "auto";
const SCALES = [1, 0.75, 0.5, 0.35, 0.25];

export class Settings {
  /** Where the scene's panel goes. */
  readonly scene = element("div", { class: "scene" });
  private readonly quality = element("select", { id: "quality" });
  private readonly scale = element("select", { id: "scale" });
  private readonly mode = element("select", { id: "mode" });
  private readonly fov = element("input", { id: "fov", type: "range", min: 10, max: 110, step: 1 });
  private readonly fovText = element("output", { for: "fov" });
  private readonly busyMark = element("span", { class: "busy", hidden: true }, "computing…");
  private readonly frameButton = element("button", { type: "button" }, "Server frame");

  constructor(
    private readonly container: HTMLElement,
    private readonly tiers: readonly string[],
    private readonly controls: Controls,
    notes: Notes,
    events: SettingsEvents,
  ) {
    const close = element("button", { type: "button", class: "plain", "aria-label": "Close the settings" }, icon("close"));
    close.addEventListener("click", () => this.toggle(false));
    const reset = element("button", { type: "button" }, "Reset this sea");
    reset.addEventListener("click", () => events.reset());
    this.frameButton.title = "The same picture, computed by the server at its own precision and size";
    this.frameButton.addEventListener("click", () => events.serverFrame());
    this.show(tiers[0] ?? "", false);
    this.quality.addEventListener("change", () => events.quality(this.quality.value === AUTO ? null : this.quality.value));
    this.showScale(null);
    this.scale.addEventListener("change", () => events.scale(this.scale.value === AUTO ? null : Number(this.scale.value)));
    fillSelect(this.mode, [{ name: "orbit", title: "orbit" }, { name: "fly", title: "look around" }], controls.mode);
    this.mode.addEventListener("change", () => (controls.mode = this.mode.value as Mode));
    this.fov.addEventListener("input", () => controls.set({ ...controls.camera, fov: Number(this.fov.value) / DEGREES }));
    controls.onMove(() => this.view());
    const row = (label: string, id: string, ...fields: HTMLElement[]) =>
      element("div", { class: "row" }, element("label", { for: id }, label), ...fields);
    container.append(
      element("div", { class: "head" }, element("h2", {}, "Settings"), this.busyMark, close),
      element(
        "div",
        { class: "body" },
        element(
          "section",
          {},
          row("quality", "quality", this.quality),
          row("resolution", "scale", this.scale),
          row("drag to", "mode", this.mode),
          row("field of view", "fov", this.fov, this.fovText),
        ),
        this.scene,
        notes.root,
        element("div", { class: "actions" }, this.frameButton, reset),
        element("p", { class: "keys" }, "Drag to look · W A S D and Q E to move · wheel or pinch to approach · shift and wheel for the lens"),
      ),
    );
    this.view();
  }

  get open(): boolean {
    return this.container.classList.contains("open");
  }

  toggle(open = !this.open): void {
    this.container.classList.toggle("open", open);
    // What cannot be seen must not take the keyboard's focus.
    this.container.inert = !open;
    document.body.classList.toggle("settings-open", open);
  }

  show(quality: string, auto: boolean): void {
    const names = new Set([...this.tiers, quality]);
    const named = [...names].map((name) => ({ name, title: qualityTitle(name) }));
    fillSelect(this.quality, [{ name: AUTO, title: "automatic" }, ...named], auto ? AUTO : quality);
  }

  showScale(scale: number | null): void {
    const shares = new Set([...SCALES, ...(scale === null ? [] : [scale])]);
    const fixed = [...shares].map((share) => ({ name: String(share), title: `${Math.round(100 * share)} %` }));
    fillSelect(this.scale, [{ name: AUTO, title: "automatic" }, ...fixed], scale === null ? AUTO : String(scale));
  }

  busy(busy: boolean): void {
    this.busyMark.hidden = !busy;
  }

  rendering(rendering: boolean): void {
    this.frameButton.disabled = rendering;
    this.frameButton.textContent = rendering ? "Rendering…" : "Server frame";
  }

  private view(): void {
    const degrees = Math.round(this.controls.camera.fov * DEGREES);
    if (document.activeElement !== this.fov) this.fov.value = String(degrees);
    this.fovText.textContent = `${degrees}°`;
  }
}
