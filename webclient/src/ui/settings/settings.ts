/** Settings panel: quality, camera, the scene's fields and the list of effects. */
import "./settings.css";
import type { CameraControls, CameraMode } from "../../camera/controls";
import type { FrameSourceChoice } from "../../display/display";
import type { FramePlan } from "../../generated/api";
import { labelOf } from "../../panel/model";
import { qualityTitle } from "../../selection/selection";
import { button, dropDown, element, fillSelect } from "../dom";
import { drawerHead, slide } from "../overlays";

interface SettingsEvents {
  quality(name: string | null): void; // null: automatic
  source(choice: FrameSourceChoice): void;
  scale(scale: number | null): void; // null: automatic
  reset(): void; // Restores the preset's scene, camera and time
  serverFrame(): void;
}

const DEGREES = 180 / Math.PI;
const AUTOMATIC = "auto";
const AUTOMATIC_TITLE = "automatic";
const SELECT = "pick min-h-9 min-w-0 flex-[0_0_154px] finger:min-h-11";
/** Of the list of effects. */
const ENTRY = "relative py-1 pl-5 before:absolute before:top-[11px] before:left-0.5 before:size-1.5 before:rounded-full";
const ACTIVE = `active ${ENTRY} before:bg-teal`;
const SKIPPED = `skipped ${ENTRY} before:border before:border-faint`;
const SCALES = [1, 0.75, 0.5, 0.35, 0.25];

export class SettingsPanel {
  readonly scene = element("div", { class: "scene pb-2" }); // Container of the scene's pane
  readonly edits = element("div"); // Container of undo, redo and the changes
  readonly effects = new EffectList();
  private readonly quality = dropDown({ id: "quality", class: SELECT }, (name) => this.events.quality(name === AUTOMATIC ? null : name));
  private tiers: readonly string[] = [];
  private readonly scale = dropDown({ id: "scale", class: SELECT }, (scale) => this.events.scale(scale === AUTOMATIC ? null : Number(scale)));
  private readonly source = dropDown({ id: "drawer", class: SELECT }, (choice) => this.events.source(choice as FrameSourceChoice));
  private readonly mode = dropDown({ id: "mode", class: SELECT }, (mode) => (this.controls.mode = mode as CameraMode));
  private readonly fov = element("input", { id: "fov", class: "min-w-0 flex-[0_0_108px]", type: "range", min: 10, max: 110, step: 1 });
  private readonly fovOutput = element("output", { for: "fov", class: "flex-[0_0_34px] text-right tabular-nums" });
  private readonly busyLabel = element("span", { class: "busy text-small text-accent", hidden: true }, "Loading plan…");
  private readonly frameButton = button(
    { class: "button disabled:cursor-progress", title: "Renders this view on the server and saves it as PNG" },
    () => this.events.serverFrame(),
    "Render on server",
  );

  constructor(private readonly container: HTMLElement, private readonly controls: CameraControls, private readonly events: SettingsEvents) {
    this.showScale(null);
    fillSelect(this.mode, [{ name: "orbit", title: "orbit" }, { name: "fly", title: "fly" }], controls.mode);
    this.fov.addEventListener("input", () => controls.set({ ...controls.camera, fov: Number(this.fov.value) / DEGREES }));
    controls.onMove(() => this.showFov());
    const row = (label: string, id: string, ...fields: HTMLElement[]) =>
      element("div", { class: "flex min-h-9 items-center gap-2 px-1.5 finger:min-h-11" }, element("label", { for: id, class: "flex-1 text-soft first-letter:uppercase" }, label), ...fields);
    container.append(
      drawerHead("Settings", () => this.toggle(false), this.busyLabel),
      element(
        "div",
        { class: "body scroller px-3 pb-3.5" },
        element(
          "section",
          { class: "pb-2" },
          row("quality", "quality", this.quality),
          row("resolution", "scale", this.scale),
          row("drawn by", "drawer", this.source),
          row("camera", "mode", this.mode),
          row("field of view", "fov", this.fov, this.fovOutput),
        ),
        this.scene,
        this.edits,
        this.effects.root,
        element("div", { class: "grid grid-cols-2 gap-2 border-t border-line pt-2.5 pb-1" }, this.frameButton, button({ class: "button" }, () => events.reset(), "Reset scene")),
        element("p", { class: "mx-1.5 mt-2.5 text-small text-dim" }, "Drag: touch the water · right drag or two fingers: rotate · W A S D, Q E: move · wheel or pinch: zoom · Shift + wheel: field of view · space: play · , and .: step a frame · /: list of waters · F: full screen · Ctrl+Z: undo"),
      ),
    );
    this.showFov();
  }

  get open(): boolean { return this.container.classList.contains("open"); }

  toggle(open = !this.open): void {
    slide(this.container, "settings", open);
  }

  /** `tiers`: what may be chosen beside the selected quality, once it is known. */
  show(quality: string, auto: boolean, tiers = this.tiers): void {
    this.tiers = tiers;
    const names = new Set([...this.tiers, quality]);
    const tierOptions = [...names].map((name) => ({ name, title: qualityTitle(name) }));
    fillSelect(this.quality, [{ name: AUTOMATIC, title: AUTOMATIC_TITLE }, ...tierOptions], auto ? AUTOMATIC : quality);
  }

  showScale(scale: number | null): void {
    const scales = new Set([...SCALES, ...(scale === null ? [] : [scale])]);
    const scaleOptions = [...scales].map((share) => ({ name: String(share), title: `${Math.round(100 * share)} %` }));
    fillSelect(this.scale, [{ name: AUTOMATIC, title: AUTOMATIC_TITLE }, ...scaleOptions], scale === null ? AUTOMATIC : String(scale));
  }

  /** `browser`: whether this browser can draw. */
  showSource(choice: FrameSourceChoice, browser: boolean): void {
    const choices = [{ name: "auto", title: AUTOMATIC_TITLE }, ...(browser ? [{ name: "browser", title: "this browser" }] : []), { name: "server", title: "the server" }];
    fillSelect(this.source, choices, choice);
  }

  setBusy(busy: boolean): void {
    this.busyLabel.hidden = !busy;
  }

  setRendering(rendering: boolean): void {
    this.frameButton.disabled = rendering;
    this.frameButton.textContent = rendering ? "Rendering…" : "Render on server";
  }

  private showFov(): void {
    const degrees = Math.round(this.controls.camera.fov * DEGREES);
    if (document.activeElement !== this.fov) this.fov.value = String(degrees);
    this.fovOutput.textContent = `${degrees}°`;
  }
}

/** Effects of the plan: active ones, and skipped ones with the plan's reason. */
class EffectList {
  readonly root = element("details", { class: "disclosure px-1.5" });

  show(plan: FramePlan | null): void {
    const { open } = this.root;
    const active = plan?.effects ?? [];
    const skipped = plan?.skipped ?? [];
    const entry = (state: string) => (effect: FramePlan["skipped"][number]) =>
      element("li", { class: state }, element("b", { class: "inline-block font-semibold text-ink first-letter:uppercase" }, labelOf(effect.name)), " ", effect.why, boundText(effect.bound));
    this.root.replaceChildren(
      element("summary", {}, `${active.length} of ${active.length + skipped.length} effects active`),
      element("ul", { class: "mb-3 text-fine text-soft" }, ...active.map(entry(ACTIVE)), ...skipped.map(entry(SKIPPED))),
    );
    this.root.open = open;
  }
}

/** Greatest pixel change that skipping the effect causes. */
function boundText(bound: number | null | undefined): string {
  if (typeof bound !== "number") return "";
  return bound === 0 ? " (no pixel changes)" : ` (pixels change by at most ${Math.ceil(25500 * bound) / 100} of 255)`;
}
