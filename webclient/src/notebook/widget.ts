/** The widget for notebooks (server/seafoam/notebook), and its requests to Python. */
import { type Choice, messageOf, type SceneSchema } from "../api";
import type { CameraState } from "../camera/state";
import { PlanPlayer } from "../export/planplayer";
import type { FramePlan } from "../generated/api";
import { ListedOptions, sceneControls } from "../panel/model";
import { ScenePane } from "../panel/pane";
import { planCovers } from "../plan/rules";
import { equal, type Json, type JsonObject, withValue } from "../scene/json";
import { button, element, prefersReducedMotion } from "../ui/dom";

/** What anywidget passes to a widget's page. */
interface Model {
  get(name: string): unknown;
  set(name: string, value: unknown): void;
  save_changes(): void;
  on(event: string, listener: (...values: never[]) => void): void;
  off(event: string, listener: (...values: never[]) => void): void;
  send(content: JsonObject): void;
}

interface Answer { value: unknown; parts: readonly DataView[]; }

/** Requests of one view; answers to other views of the same model are ignored. */
class Kernel {
  private readonly waiting = new Map<string, { resolve: (answer: Answer) => void; reject: (error: Error) => void }>();
  private readonly name = crypto.getRandomValues(new Uint32Array(4)).join("-");
  private count = 0;

  constructor(private readonly model: Model) {
    model.on("msg:custom", this.receive);
  }

  ask(kind: string, fields: JsonObject = {}): Promise<Answer> {
    const id = `${this.name}/${++this.count}`;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.model.send({ id, kind, ...fields });
    });
  }

  dispose(): void {
    this.model.off("msg:custom", this.receive);
    this.waiting.clear();
  }

  private readonly receive = ({ id, value, error }: { id: string; value?: unknown; error?: string }, parts: readonly DataView[] = []): void => {
    const request = this.waiting.get(id);
    if (request === undefined) return;
    this.waiting.delete(id);
    if (error === undefined) request.resolve({ value, parts });
    else request.reject(new Error(error));
  };
}

/** Notebooks have no style sheet of ours. */
const STYLE = `
.seafoam-widget { display: grid; grid-template-columns: minmax(0, 1fr) auto; gap: 8px; }
.seafoam-main { position: relative; aspect-ratio: 16 / 9; overflow: hidden; }
.seafoam-picture, .seafoam-picture canvas { position: absolute; inset: 0; width: 100%; height: 100%; }
.seafoam-picture canvas { touch-action: pan-y; }
.seafoam-bar { position: absolute; left: 8px; bottom: 8px; display: flex; gap: 4px; }
.seafoam-bar button { font: 13px system-ui, sans-serif; padding: 4px 10px; border: 0; border-radius: 4px; color: #fff; background: rgb(0 0 0 / 0.55); cursor: pointer; }
.seafoam-bar button:focus-visible { outline: 2px solid #fff; }
.seafoam-message { position: absolute; inset: 8px 8px auto; margin: 0; padding: 6px 10px; font: 13px system-ui, sans-serif; color: #fff; background: #8b1a1a; border-radius: 4px; }
.seafoam-message[hidden], .seafoam-side[hidden] { display: none; }
/* As high as the picture, whatever it holds. */
.seafoam-side { width: 300px; height: 0; min-height: 100%; overflow: auto; }
.seafoam-side .with-log { display: flex; gap: 4px; }
.seafoam-side .with-log .log { flex: 1 1 60%; min-width: 0; }
`;

const REPORT_INTERVAL = 500; // Between reports of camera and time to Python, ms

interface Drawn {
  player: PlanPlayer;
  plan: FramePlan;
  /** Scene and quality that the plan was made for. */
  scene: JsonObject;
  quality: Json;
}

/** One view of the widget: the picture, its controls, and the panel with the scene's fields. */
class WaterView {
  private readonly kernel: Kernel;
  private readonly picture = element("div", { class: "seafoam-picture" });
  private readonly side = element("div", { class: "seafoam-side" });
  private readonly message = element("p", { class: "seafoam-message", role: "alert" });
  private readonly play = button({}, () => this.tell("playing", !this.model.get("playing")));
  private readonly fields = button({}, () => this.tell("panel", !this.model.get("panel")), "Scene");
  private readonly visible: IntersectionObserver;
  private readonly reducedMotion = prefersReducedMotion();
  private readonly listeners: [string, () => void][];
  private readonly options = new ListedOptions(
    async (url) => (await this.kernel.ask("choices", { url })).value as Choice[],
    () => this.showFields(true),
    (error) => this.failed(error),
  );
  private readonly reporter: number;
  private drawn: Drawn | null = null;
  private pane: ScenePane | null = null;
  private schema: SceneSchema | null = null;
  private active = false;
  /** What Python knows. */
  private reported: { camera: CameraState; time: number };
  private run = 0; // Number of the latest load; earlier ones are outdated

  constructor(private readonly model: Model, private readonly root: HTMLElement) {
    this.kernel = new Kernel(model);
    this.reported = { camera: this.camera, time: this.time };
    const bar = element("div", { class: "seafoam-bar" }, this.play, this.fields);
    const main = element("div", { class: "seafoam-main" }, this.picture, bar, this.message);
    root.classList.add("seafoam-widget");
    root.append(element("style", {}, STYLE), main, this.side);
    this.listeners = [
      ["change:scene", () => void this.load()],
      ["change:quality", () => void this.load()],
      ["change:camera", () => this.cameraChanged()],
      ["change:time", () => this.timeChanged()],
      ["change:playing", () => this.playingChanged()],
      ["change:panel", () => void this.panelChanged()],
      ["change:error", () => this.say(String(model.get("error")))],
    ];
    for (const [event, listener] of this.listeners) model.on(event, listener);
    this.visible = new IntersectionObserver((entries) => {
      this.active = entries.at(-1)?.isIntersecting ?? false;
      if (this.drawn) this.drawn.player.active = this.active;
    });
    this.visible.observe(root);
    this.reporter = window.setInterval(() => this.report(), REPORT_INTERVAL);
    this.playingChanged();
    void this.load();
    void this.panelChanged();
  }

  dispose(): void {
    this.run += 1;
    this.report();
    window.clearInterval(this.reporter);
    this.visible.disconnect();
    for (const [event, listener] of this.listeners) this.model.off(event, listener);
    this.kernel.dispose();
    this.drawn?.player.dispose();
    this.root.replaceChildren();
  }

  private get scene(): JsonObject { return this.model.get("scene") as JsonObject; }

  private get camera(): CameraState { return this.model.get("camera") as CameraState; }

  private get time(): number { return this.model.get("time") as number; }

  private get playing(): boolean { return this.model.get("playing") === true && !this.reducedMotion; }

  private tell(name: string, value: unknown): void {
    this.model.set(name, value);
    this.model.save_changes();
  }

  /** Draws the model's scene: by the present plan if that covers it, else by another in its place once it is ready. */
  private async load(): Promise<void> {
    const { scene, drawn } = this;
    const quality = this.model.get("quality") as Json;
    const run = ++this.run;
    this.showFields();
    if (drawn && equal(drawn.quality, quality) && planCovers(drawn.plan, drawn.scene, scene)) {
      drawn.player.scene = scene;
      drawn.player.redraw();
      this.say("");
      return;
    }
    let next: Drawn | null = null;
    try {
      const plan = (await this.kernel.ask("plan", { scene, quality })).value as FramePlan;
      if (run !== this.run) return;
      next = this.prepare(plan, scene, quality);
      await next.player.load();
      if (run === this.run) this.replace(next);
      else this.discard(next);
    } catch (error) {
      if (next) this.discard(next);
      if (run === this.run) this.failed(error);
    }
  }

  private prepare(plan: FramePlan, scene: JsonObject, quality: Json): Drawn {
    const canvas = element("canvas", { tabindex: "0", role: "application", "aria-label": "Water" });
    // Below the present picture, until it is drawn.
    this.picture.prepend(canvas);
    const camera = this.drawn ? this.drawn.player.controls.camera : this.camera;
    const player = new PlanPlayer(canvas, {
      plan,
      camera,
      bytes: async ({ url }) => bytesOf((await this.kernel.ask("texture", { url })).parts),
      time: this.drawn?.player.time ?? this.time,
      playing: this.playing,
      reducedMotion: this.reducedMotion,
    });
    player.failed = (error) => this.failed(error);
    // The wheel scrolls the notebook unless the picture has the focus.
    canvas.addEventListener("wheel", (event) => document.activeElement === canvas || event.stopImmediatePropagation(), { capture: true });
    return { player, plan, scene, quality };
  }

  private replace(next: Drawn): void {
    const before = this.drawn;
    this.drawn = next;
    this.say("");
    next.player.active = this.active;
    next.player.playing = this.playing;
    // Camera and time may have moved on while it was loading.
    next.player.controls.set(before ? before.player.controls.camera : this.camera);
    next.player.time = before ? before.player.time : this.time;
    if (before === null) return;
    const focused = document.activeElement === before.player.canvas;
    this.discard(before);
    if (focused) next.player.canvas.focus();
  }

  private discard({ player }: Drawn): void {
    player.dispose();
    player.canvas.remove();
  }

  private cameraChanged(): void {
    const { camera } = this;
    if (equal(camera as unknown as Json, this.reported.camera as unknown as Json)) return;
    this.reported = { ...this.reported, camera };
    this.drawn?.player.controls.set(camera);
  }

  private timeChanged(): void {
    const { time, drawn } = this;
    if (time === this.reported.time) return;
    this.reported = { ...this.reported, time };
    if (drawn === null) return;
    drawn.player.time = time;
    drawn.player.redraw();
  }

  private playingChanged(): void {
    this.play.textContent = this.playing ? "Pause" : "Play";
    if (this.drawn) this.drawn.player.playing = this.playing;
  }

  /** Tells Python camera and time, where the picture has moved on. */
  private report(): void {
    if (this.drawn === null) return;
    const { controls: { camera }, time } = this.drawn.player;
    const { reported } = this;
    if (camera === reported.camera && time === reported.time) return;
    this.reported = { camera, time };
    if (camera !== reported.camera) this.model.set("camera", camera);
    if (time !== reported.time) this.model.set("time", time);
    this.model.save_changes();
  }

  private async panelChanged(): Promise<void> {
    const open = this.model.get("panel") === true;
    this.side.hidden = !open;
    this.fields.setAttribute("aria-pressed", String(open));
    if (!open) return;
    try {
      this.schema ??= (await this.kernel.ask("schema")).value as SceneSchema;
    } catch (error) {
      this.failed(error);
      return;
    }
    this.pane ??= new ScenePane(this.side, {
      change: (pointer, value) => this.tell("scene", withValue(this.scene, pointer, value)),
      optionsFrom: (url) => this.options.from(url),
    });
    this.showFields();
  }

  private showFields(rebuild = false): void {
    const controls = this.schema && sceneControls(this.schema, this.scene);
    if (controls) this.pane?.show(controls, this.scene, rebuild);
  }

  private failed(error: unknown): void {
    this.say(messageOf(error));
  }

  private say(text: string): void {
    this.message.textContent = text;
    this.message.hidden = text === "";
  }
}

/** The bytes of a binary answer, at an address of their own. */
function bytesOf([part]: readonly DataView[]): ArrayBuffer {
  if (part === undefined) throw new Error("Python sent no texture.");
  return new Uint8Array(part.buffer, part.byteOffset, part.byteLength).slice().buffer;
}

/** Called by anywidget for each view of the widget. */
function render({ model, el }: { model: Model; el: HTMLElement }): () => void {
  const view = new WaterView(model, el);
  return () => view.dispose();
}

export default { render };
