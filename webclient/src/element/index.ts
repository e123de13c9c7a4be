/** The element `<seafoam-water>`: water of a Seafoam server in any page. Attributes: README.md of the package. */
import { Api, ApiError } from "../api";
import { CameraControls } from "../camera/controls";
import { cameraFromScene } from "../camera/state";
import { CapabilityError } from "../gl/capabilities";
import { Stage } from "../export/stage";

const CLEARANCE = 0.3;
const STYLE = ":host { display: block; position: relative; aspect-ratio: 16 / 9; overflow: hidden; } canvas, img { position: absolute; inset: 0; width: 100%; height: 100%; border: 0; } img { object-fit: cover; } canvas { touch-action: pan-y; }";

export class SeafoamWater extends HTMLElement {
  static readonly observedAttributes = ["preset", "time", "quality", "server", "paused"];
  private stage: Stage | null = null;
  private visible = false;
  private queued = false;
  /** Number of the latest load; earlier ones are outdated. */
  private run = 0;
  private readonly root = this.attachShadow({ mode: "open" });
  private readonly observer = new IntersectionObserver((entries) => {
    this.visible = entries.at(-1)?.isIntersecting ?? false;
    this.updateActivity();
  });

  connectedCallback(): void {
    this.observer.observe(this);
    document.addEventListener("visibilitychange", this.updateActivity);
    this.queue();
  }

  disconnectedCallback(): void {
    this.observer.disconnect();
    document.removeEventListener("visibilitychange", this.updateActivity);
    this.clear();
  }

  attributeChangedCallback(name: string): void {
    if (name === "paused" && this.stage) this.stage.playing = !this.hasAttribute("paused");
    else this.queue();
  }

  /** Time of the picture, s. */
  get currentTime(): number {
    return this.stage?.time ?? this.startTime ?? 0;
  }

  /** Frames that were drawn; 0 while a still of the server is shown. */
  get frames(): number {
    return this.stage?.frames ?? 0;
  }

  private get startTime(): number | null {
    const text = this.getAttribute("time");
    const value = text === null || text === "" ? NaN : Number(text);
    return Number.isFinite(value) ? value : null;
  }

  private readonly updateActivity = (): void => {
    if (this.stage) this.stage.active = this.visible && !document.hidden;
  };

  /** Loads once for all attributes that change together. */
  private queue(): void {
    if (this.queued || !this.isConnected) return;
    this.queued = true;
    queueMicrotask(() => {
      this.queued = false;
      if (this.isConnected) void this.load();
    });
  }

  private clear(): void {
    this.run += 1;
    this.stage?.dispose();
    this.stage = null;
    this.root.replaceChildren();
  }

  private async load(): Promise<void> {
    this.clear();
    const { run } = this;
    const preset = this.getAttribute("preset") ?? "default";
    const quality = this.getAttribute("quality") ?? "standard";
    const base = new URL(this.getAttribute("server") ?? ".", document.baseURI).href.replace(/\/?$/, "/");
    const style = document.createElement("style");
    style.textContent = STYLE;
    this.root.append(style);
    try {
      const api = new Api(base);
      const [{ scene, title, time }, plan] = await Promise.all([api.preset(preset), api.presetPlan(preset, quality)]);
      if (run !== this.run) return;
      const canvas = document.createElement("canvas");
      canvas.tabIndex = 0;
      canvas.setAttribute("role", "application");
      canvas.setAttribute("aria-label", this.getAttribute("aria-label") ?? title);
      this.root.append(canvas);
      // The wheel scrolls the page unless the canvas has the focus.
      canvas.addEventListener("wheel", (event) => this.root.activeElement === canvas || event.stopImmediatePropagation());
      const camera = cameraFromScene(scene);
      const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
      const stage = new Stage(canvas, {
        plan,
        camera,
        bytes: (texture) => api.texture(texture),
        time: this.startTime ?? time,
        playing: !this.hasAttribute("paused") && !still,
      });
      this.stage = stage;
      this.updateActivity();
      const controls = new CameraControls(canvas, camera, !still);
      controls.surface = controls.bottom = plan.top + CLEARANCE;
      stage.beforeFrame = (seconds) => {
        const moved = controls.step(seconds);
        stage.camera = controls.camera;
        return moved;
      };
      stage.failed = (error) => this.failed(error);
      await stage.load();
      if (run === this.run) this.dispatchEvent(new Event("load"));
    } catch (error) {
      if (run !== this.run) return;
      if (error instanceof CapabilityError) this.showStill(base, preset, quality);
      else this.failed(error);
    }
  }

  /** The server's picture, where the browser cannot draw. */
  private showStill(base: string, preset: string, quality: string): void {
    this.root.querySelector("canvas")?.remove();
    this.stage = null;
    const address = new URL(`api/frames/${encodeURIComponent(preset)}.png`, base);
    const { width, height } = this.getBoundingClientRect();
    address.searchParams.set("quality", quality);
    address.searchParams.set("width", String(Math.max(1, Math.round(width))));
    address.searchParams.set("height", String(Math.max(1, Math.round(height))));
    if (this.startTime !== null) address.searchParams.set("time", String(this.startTime));
    const image = document.createElement("img");
    image.alt = this.getAttribute("aria-label") ?? `Water: ${preset}`;
    image.addEventListener("load", () => this.dispatchEvent(new Event("load")));
    image.addEventListener("error", () => this.failed(new Error("The server's picture could not be loaded.")));
    image.src = address.href;
    this.root.append(image);
  }

  private failed(error: unknown): void {
    const details = error instanceof ApiError ? error.details.map((detail) => `: ${detail}`).join("") : "";
    const message = error instanceof Error ? error.message : String(error);
    this.dispatchEvent(new ErrorEvent("error", { error, message: message + details }));
  }
}

if (customElements.get("seafoam-water") === undefined) customElements.define("seafoam-water", SeafoamWater);
