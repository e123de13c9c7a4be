/** The element `<seafoam-water>`: water of a Seafoam server in any page. Attributes: README.md of the package. */
import { Api, ApiError, messageOf } from "../api";
import { cameraFromScene } from "../camera/state";
import { CapabilityError } from "../gl/capabilities";
import { PlanPlayer } from "../export/planplayer";
import { element, prefersReducedMotion } from "../ui/dom";
import { stillUrl } from "../ui/still";

const STYLE = ":host { display: block; position: relative; aspect-ratio: 16 / 9; overflow: hidden; } canvas, img { position: absolute; inset: 0; width: 100%; height: 100%; border: 0; } img { object-fit: cover; } canvas { touch-action: pan-y; } p { position: absolute; inset: auto 0 0; margin: 0; padding: 8px 12px; font: 14px/1.4 system-ui, sans-serif; color: #fff; background: rgb(0 0 0 / 0.75); }";

class SeafoamWater extends HTMLElement {
  static readonly observedAttributes = ["preset", "time", "quality", "server", "paused"];
  private player: PlanPlayer | null = null;
  private visible = false;
  private queued = false;
  private run = 0; // Number of the latest load; earlier ones are outdated
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
    if (name === "paused" && this.player) this.player.playing = !this.hasAttribute("paused");
    else this.queue();
  }

  /** Time of the picture, s. */
  get currentTime(): number { return this.player?.time ?? this.startTime ?? 0; }

  /** Frames that were drawn; 0 while a still of the server is shown. */
  get frames(): number { return this.player?.frames ?? 0; }

  private get startTime(): number | null {
    const text = this.getAttribute("time");
    const value = text === null || text === "" ? NaN : Number(text);
    return Number.isFinite(value) ? value : null;
  }

  private readonly updateActivity = (): void => {
    if (this.player) this.player.active = this.visible && !document.hidden;
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
    this.player?.dispose();
    this.player = null;
    this.root.replaceChildren();
  }

  private async load(): Promise<void> {
    this.clear();
    const { run } = this;
    const preset = this.getAttribute("preset") ?? "default";
    const quality = this.getAttribute("quality") ?? "standard";
    const base = new URL(this.getAttribute("server") ?? ".", document.baseURI).href.replace(/\/?$/, "/");
    const poster = this.picture(new URL(stillUrl(preset), base).href, preset);
    poster.addEventListener("error", () => poster.remove());
    this.root.append(element("style", {}, STYLE), poster);
    try {
      const api = new Api(base);
      const [{ scene, title, time }, plan] = await Promise.all([api.preset(preset), api.presetPlan(preset, quality)]);
      if (run !== this.run) return;
      const canvas = element("canvas", { tabindex: 0, role: "application", "aria-label": this.getAttribute("aria-label") ?? title });
      // Below the still, until it is drawn.
      poster.before(canvas);
      // The wheel scrolls the page unless the canvas has the focus.
      canvas.addEventListener("wheel", (event) => this.root.activeElement === canvas || event.stopImmediatePropagation());
      const reducedMotion = prefersReducedMotion();
      const player = new PlanPlayer(canvas, {
        plan,
        camera: cameraFromScene(scene),
        bytes: api.texture,
        time: this.startTime ?? time,
        playing: !this.hasAttribute("paused") && !reducedMotion,
        reducedMotion,
      });
      this.player = player;
      this.updateActivity();
      player.beforeFrame = () => {
        if (player.frames > 0) poster.remove();
      };
      player.failed = (error) => void this.failed(error, base);
      await player.load();
      if (run === this.run) this.dispatchEvent(new Event("load"));
    } catch (error) {
      if (run !== this.run) return;
      if (error instanceof CapabilityError) this.showFrame(base, preset, quality, poster);
      else await this.failed(error, base);
    }
  }

  private picture(address: string, preset: string): HTMLImageElement {
    return element("img", { alt: this.getAttribute("aria-label") ?? `Water: ${preset}`, src: address });
  }

  /** The server's frame, where the browser cannot draw. */
  private showFrame(base: string, preset: string, quality: string, poster: HTMLImageElement): void {
    this.root.querySelector("canvas")?.remove();
    this.player = null;
    const address = new URL(`api/frames/${encodeURIComponent(preset)}.png`, base);
    const { width, height } = this.getBoundingClientRect();
    const side = (length: number) => Math.max(1, Math.round(length));
    const query = { quality, width: side(width), height: side(height), ...(this.startTime === null ? {} : { time: this.startTime }) };
    for (const [name, value] of Object.entries(query)) address.searchParams.set(name, String(value));
    const image = this.picture(address.href, preset);
    image.addEventListener("load", () => {
      poster.remove();
      this.dispatchEvent(new Event("load"));
    });
    image.addEventListener("error", () => void this.failed(new Error("The server's picture could not be loaded."), base));
    this.root.append(image);
  }

  /** Says what is wrong over what is shown, and to the page. */
  private async failed(error: unknown, base: string): Promise<void> {
    const { run } = this;
    const message = await reason(error, base);
    if (run !== this.run) return;
    this.root.append(element("p", { role: "alert" }, message));
    this.dispatchEvent(new ErrorEvent("error", { error, message }));
  }
}

/** What went wrong, and the remedy where the server answers but lets no page of this site read that. */
async function reason(error: unknown, base: string): Promise<string> {
  if (!(error instanceof ApiError)) return messageOf(error);
  const server = new URL(base).origin;
  if (error.status === 0 && server !== location.origin) {
    // What it answers cannot be read, but whether it answers can be told.
    const answers = await fetch(base, { mode: "no-cors" }).then(() => true, () => false);
    if (answers) return `${server} does not allow pages of ${location.origin} to read its data. Its operator allows them with SEAFOAM_CORS_ORIGINS=${location.origin}.`;
  }
  return error.message + error.details.map((detail) => `: ${detail}`).join("");
}

if (customElements.get("seafoam-water") === undefined) customElements.define("seafoam-water", SeafoamWater);
