/** The page as a whole: joins what the visitor chooses to what is drawn. */
import type { AccuracyView } from "../accuracy/view";
import { type Api, ApiError, type Choice, type Preset, type PresetSummary } from "../api";
import { Controls } from "../camera/controls";
import { cameraFromScene } from "../camera/state";
import { CapabilityError } from "../gl/capabilities";
import { openContext } from "../gl/gpu";
import { controlOf, type GroupControl, choices as choicesIn, schemaNamed } from "../panel/model";
import type { ScenePane } from "../panel/pane";
import { compile } from "../plan/executor";
import { CAMERA } from "../plan/live";
import { apply, diff, equal, get, isObject, type Json, type JsonObject, steps, withValue } from "../scene/json";
import { type Hook, renderOffscreen } from "../testhook";
import type { Curtain } from "../ui/curtain";
import { type Comparable, Divider, plainOptions } from "../ui/divider";
import { byId, element } from "../ui/dom";
import { Gallery } from "../ui/gallery";
import { icon, type IconName } from "../ui/icons";
import { Notes } from "../ui/notes";
import { Readout } from "../ui/readout";
import { Settings } from "../ui/settings";
import { Still } from "../ui/still";
import { Toasts } from "../ui/toast";
import { Transport } from "../ui/transport";
import { Clock } from "./clock";
import { AutoQuality, type Fronts } from "./front";
import { qualityOf, qualityTitle } from "./quality";
import { Slot } from "./slot";
import { Stage } from "./stage";
import { type Choices, type Split, Store } from "./store";
import { decode, encode, type LinkState } from "./url";

/** Names the quality, where it is what two pictures are compared by. */
const QUALITY = "quality";
const QUALITY_DEFAULT = "standard";
/** The address follows the visitor's choices once they rest, ms. */
const ADDRESS_REST = 400;
/** The camera's least height over the highest crest, m. */
const CLEARANCE = 0.3;

export class App {
  private readonly clock = new Clock();
  private readonly toasts = new Toasts(byId("toasts"));
  private readonly readout = new Readout();
  private readonly notes = new Notes();
  private readonly names = new Map<string, readonly Choice[]>();
  private readonly slots: readonly [Slot, Slot];
  private readonly stage: Stage;
  private readonly controls: Controls;
  private readonly settings: Settings;
  private readonly gallery: Gallery;
  private readonly divider: Divider;
  /** The scene's fields, which are loaded when they are first looked at. */
  private pane: ScenePane | null = null;
  private readonly transport: Transport;
  private readonly busy = new Set<number>();
  private addressTimer = 0;
  private lastTick = 0;
  private readonly autoQuality = new AutoQuality();
  /** What was measured of every tier; null until it is here. */
  private fronts: Fronts | null = null;
  /** The scale at which the quality that was chosen last should run. */
  private expectedScale: number | null = null;
  /** Whether the water that was last chosen has been on the canvas; until then its still stands for it, and time with it. */
  private live = false;
  private accuracy: AccuracyView | null = null;
  private accuracyShown = false;
  private settle: { resolve: () => void; reject: (error: unknown) => void } | null = null;

  /** Reads the address, asks the server for what it names, and starts to draw. */
  static async open(api: Api, curtain: Curtain): Promise<void> {
    const link = decode(location.hash);
    // Asked for at once, if the page was built with it: a visitor without a link comes to the preset whose still it begins with.
    const { preset: first = "", stills = "" } = document.documentElement.dataset;
    const likely = link.preset ?? first;
    const early = stills.split(" ").includes(likely) ? api.preset(likely).catch(() => null) : null;
    const asked = Promise.all([api.presets(), api.openapi(), early]);
    // Where GL cannot start, that is what the visitor is told.
    asked.catch(() => undefined);
    const still = new Still(byId("still") as HTMLImageElement);
    await still.painted();
    // The browser starts the GPU while the server answers.
    openContext(byId("canvas") as HTMLCanvasElement);
    const [presets, openapi, ready] = await asked;
    const known = presets.find(({ name }) => name === link.preset);
    const opened = known ?? presets[0];
    if (opened === undefined) throw new Error("The server has no presets.");
    const preset = ready?.name === opened.name ? ready : await api.preset(opened.name);
    const unknown = link.preset !== null && known === undefined;
    // What a link says of one sea means nothing for another.
    const kept = unknown ? { ...link, changes: [], time: null, camera: null, split: null } : link;
    const app = new App(api, curtain, still, presets, openapi, preset, kept);
    if (unknown) app.toasts.show(`There is no sea “${link.preset}” here; this is “${preset.title}”.`, [], "error");
  }

  private readonly store: Store;

  private constructor(
    private readonly api: Api,
    private readonly curtain: Curtain,
    private readonly still: Still,
    presets: readonly PresetSummary[],
    private readonly openapi: JsonObject,
    preset: Preset,
    link: LinkState,
  ) {
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.store = new Store(chosen(preset, link));
    this.clock.jump(link.time ?? preset.time);
    this.clock.setSpeed(link.speed ?? 1);
    this.clock.playing = !(link.paused ?? calm);

    this.slots = [this.makeSlot(0), this.makeSlot(1)];
    const hidden = new Set((new URLSearchParams(location.search).get("hide") ?? "").split(",").filter(Boolean));
    const canvas = byId("canvas") as HTMLCanvasElement;
    this.stage = new Stage(canvas, this.slots, hidden, {
      lost: () => this.toasts.show("The graphics driver took a break; the picture comes back by itself."),
      restored: () => this.slots.forEach((slot) => slot.reload()),
      failed: (error) => this.failed(error),
      drawn: () => this.drawn(),
    });
    this.stage.fix(link.scale);
    this.controls = new Controls(canvas, link.camera ?? cameraFromScene(preset.scene), !calm);
    this.settings = new Settings(byId("settings"), this.tiers(), this.controls, this.notes, {
      quality: (quality) => {
        const { quality: now } = this.store.now;
        this.store.set({ quality: quality ?? now, auto: quality === null, split: this.splitWith(QUALITY, quality ?? now) });
      },
      scale: (scale) => this.fixScale(scale),
      reset: () => this.reset(),
      serverFrame: () => void this.serverFrame(),
    });
    this.gallery = new Gallery(byId("gallery"), presets, (name) => void this.choose(name));
    this.divider = new Divider(
      byId("divider"),
      (split) => this.store.set({ split }),
      (field) => this.compareBy(field),
    );
    this.transport = new Transport(byId("transport"), this.clock, () => this.store.now.preset.time, this.readout.root);
    this.tools();
    this.showAccuracy(link.accuracy === true);
    // The sea is seen first.
    this.settings.toggle(false);

    this.store.onChange((now) => this.changed(now));
    this.clock.onChange(() => this.moved());
    this.controls.onMove(() => {
      this.still.drop();
      this.moved();
    });
    window.addEventListener("hashchange", () => void this.follow(decode(location.hash)));
    setInterval(() => {
      const { quality, auto } = this.store.now;
      this.readout.show(this.stage.timing(), this.clock.playing, qualityTitle(quality), auto);
      this.improve();
      if (this.clock.playing) this.transport.update();
    }, 250);

    window.seafoam = this.hook();
    this.showChoices(this.store.now);
    this.plan(0);
    requestAnimationFrame((now) => this.tick(now));
  }

  private makeSlot(index: 0 | 1): Slot {
    return new Slot(this.api, {
      gpu: () => this.stage.gpu,
      camera: () => this.controls.camera,
      whole: () => this.limit(),
      changed: (fresh) => {
        if (fresh) this.planned();
        this.stage.dirty = true;
      },
      failed: (error) => this.failed(error),
      busy: (busy) => {
        if (busy) this.busy.add(index);
        else this.busy.delete(index);
        this.settings.busy(this.busy.size > 0);
      },
    });
  }

  private tick(now: number): void {
    requestAnimationFrame((next) => this.tick(next));
    const seconds = this.lastTick === 0 ? 0 : (now - this.lastTick) / 1000;
    this.lastTick = now;
    const moving = this.controls.step(seconds);
    // A still stands for the first moment, which must be what comes after it.
    if (this.live) this.clock.advance(seconds);
    this.stage.tick(now, this.view(), moving || (this.live && this.clock.playing));
  }

  /** Runs another tier where that shows the sea better in the time there is. */
  private improve(): void {
    const { preset, quality, auto, split } = this.store.now;
    if (!auto || split !== null || !this.live || !this.clock.playing || this.busy.size > 0 || this.fronts === null) return;
    const pacing = this.stage.pacing();
    const choice = pacing && this.autoQuality.next(this.fronts, preset.name, quality, pacing);
    if (choice === null) return;
    this.expectedScale = choice.scale;
    this.store.set({ quality: choice.tier });
  }

  /** A frame is on the canvas: the first of a picture takes its still's place. */
  private drawn(): void {
    if (this.clock.playing) this.transport.move();
    if (this.live || this.busy.has(0)) return;
    this.live = true;
    this.still.lift();
    this.curtain.lift();
    this.settle?.resolve();
    if (this.fronts === null) {
      this.api.fronts().then(
        (fronts) => (this.fronts = fronts),
        // Without it the quality stays what it is.
        () => undefined,
      );
    }
  }

  private view() {
    return { time: this.clock.time, camera: this.controls.camera, divider: this.store.now.split?.at ?? 1 };
  }

  /** Something was chosen. */
  private changed(now: Choices): void {
    this.showChoices(now);
    this.plan();
    this.moved();
  }

  /** Time or camera moved, or something was chosen: the picture and the address follow. */
  private moved(): void {
    this.stage.dirty = true;
    clearTimeout(this.addressTimer);
    this.addressTimer = window.setTimeout(() => history.replaceState(null, "", `#${encode(this.link(false))}`), ADDRESS_REST);
  }

  private plan(delay?: number): void {
    const { scene, quality, split } = this.store.now;
    const wanted = (value: string | null) => {
      if (split === null || value === null) return { scene, quality: qualityOf(quality) };
      return split.field === QUALITY
        ? { scene, quality: qualityOf(value) }
        : { scene: withValue(scene, split.field, value), quality: qualityOf(quality) };
    };
    const [left, right] = this.slots;
    left.show(wanted(split?.left ?? null), delay);
    if (split) right.show(wanted(split.right), delay);
    else right.clear();
  }

  /** A slot has a new picture. */
  private planned(): void {
    const { plan } = this.slots[0];
    this.notes.show(plan);
    this.limit();
    this.stage.reconsider(this.expectedScale);
    this.expectedScale = null;
  }

  /** How low the camera may go: under the surface once that is drawn. */
  private limit(): void {
    const executor = this.slots[0].ready?.executor;
    if (executor === undefined) return;
    const { plan } = executor;
    const dives = plan.passes.some((pass) => pass.eye === "under") && executor.has("under");
    this.controls.surface = plan.top + CLEARANCE;
    this.controls.bottom = dives ? plan.bottom + CLEARANCE : this.controls.surface;
  }

  private showChoices({ preset, quality, auto, split }: Choices): void {
    byId("title").textContent = preset.title;
    byId("summary").textContent = preset.summary;
    document.title = `${preset.title} · Seafoam`;
    this.gallery.select(preset.name);
    this.settings.show(quality, auto);
    this.showPane();
    this.divider.show(split, this.comparables());
  }

  /** Shows the scene's fields as they are. `anew`: what they offer has changed. */
  private showPane(anew = false): void {
    const { scene } = this.store.now;
    const model = this.pane && this.panel(scene);
    if (model) this.pane?.show(model, scene, anew);
  }

  private loadPane(): void {
    if (this.pane) return;
    import("../panel/pane").then(
      ({ ScenePane: Pane }) => {
        this.pane ??= new Pane(this.settings.scene, {
          change: (pointer, value) => this.edit(pointer, value),
          names: (url) => this.namesFrom(url),
        });
        this.showPane();
      },
      (error: unknown) => this.failed(error),
    );
  }

  /** The panel's model; the camera has controls of its own. */
  private panel(scene: JsonObject): GroupControl | null {
    const schema = schemaNamed(this.openapi, "Scene");
    const control = schema && controlOf(this.openapi, schema, scene, "", "scene");
    if (control?.kind !== "group") return null;
    return { ...control, children: control.children.filter(({ pointer }) => pointer !== CAMERA) };
  }

  /** All that two pictures can differ in: every choice of the scene at hand, and the quality. */
  private comparables(): Comparable[] {
    const model = this.panel(this.store.now.scene);
    const fields = (model ? choicesIn(model) : []).map((control) => ({
      field: control.pointer,
      title: control.label,
      options: control.kind === "choice" ? plainOptions(control.options) : this.namesFrom(control.url),
    }));
    const { quality } = this.store.now;
    const qualities = [...new Set([...this.tiers(), quality])].map((name) => ({ name, title: qualityTitle(name) }));
    return [...fields, { field: QUALITY, title: QUALITY, options: qualities }];
  }

  /** The panel moved a field of the scene. */
  private edit(pointer: string, value: Json): void {
    const scene = withValue(this.store.now.scene, pointer, value);
    if (!isObject(scene)) return;
    this.store.set({ scene, split: fitting(scene, this.splitWith(pointer, value)) });
  }

  /** The comparison after a field was set: the right picture follows the field that is compared. */
  private splitWith(field: string, value: Json): Split | null {
    const { split } = this.store.now;
    return split?.field === field && typeof value === "string" ? { ...split, right: value } : split;
  }

  private toggleSplit(): void {
    if (this.store.now.split) {
      this.store.set({ split: null });
      return;
    }
    // The choice with the most values has the most to show.
    const [first] = this.comparables().sort((a, b) => Number(isPlain(b)) - Number(isPlain(a)) || b.options.length - a.options.length);
    if (first) this.compareBy(first.field);
  }

  /** Starts a comparison: what the scene has now against the first other value. */
  private compareBy(field: string): void {
    const { scene, quality, split } = this.store.now;
    const options = this.comparables().find((each) => each.field === field)?.options ?? [];
    const current = field === QUALITY ? quality : get(scene, field);
    const right = typeof current === "string" ? current : (options.at(-1)?.name ?? "");
    const left = options.find(({ name }) => name !== right)?.name ?? right;
    this.store.set({ split: { field, left, right, at: split?.at ?? 0.5 } });
  }

  /** Names that the server lists; asked for once. */
  private namesFrom(url: string): readonly Choice[] {
    const known = this.names.get(url);
    if (known) return known;
    this.names.set(url, []);
    this.api.choices(url).then(
      (names) => {
        this.names.set(url, names);
        this.showPane(true);
        this.divider.show(this.store.now.split, this.comparables());
      },
      (error: unknown) => {
        this.names.delete(url);
        this.failed(error);
      },
    );
    return [];
  }

  /** The tiers of quality, as the server's own description lists them. */
  private tiers(): string[] {
    const paths = get(this.openapi, "/paths/~1api~1plans~1{preset}/get/parameters");
    const parameter = Array.isArray(paths) ? paths.find((p) => isObject(p) && p["name"] === QUALITY) : undefined;
    const schema = parameter === undefined ? undefined : get(parameter, "/schema");
    const reference = isObject(schema) ? schema["$ref"] : undefined;
    const resolved = typeof reference === "string" ? get(this.openapi, reference.slice(1)) : schema;
    const tiers = isObject(resolved) ? resolved["enum"] : undefined;
    return Array.isArray(tiers) ? tiers.filter((tier) => typeof tier === "string") : [QUALITY_DEFAULT];
  }

  private async choose(name: string): Promise<void> {
    if (name === this.store.now.preset.name) return;
    this.still.show(name);
    try {
      const preset = await this.api.preset(name);
      // Its clock waits for it.
      this.live = false;
      this.open(preset);
    } catch (error) {
      this.still.drop();
      this.failed(error);
    }
  }

  private fixScale(scale: number | null): void {
    this.stage.fix(scale);
    this.settings.showScale(scale);
    this.moved();
  }

  private open(preset: Preset): void {
    this.controls.set(cameraFromScene(preset.scene));
    this.clock.jump(preset.time);
    this.autoQuality.begin();
    this.store.set({ preset, scene: preset.scene, split: fitting(preset.scene, this.store.now.split) });
  }

  private reset(): void {
    this.open(this.store.now.preset);
  }

  /** Goes where an edited or pasted address points. */
  private async follow(link: LinkState): Promise<void> {
    try {
      const { preset: current } = this.store.now;
      const preset = link.preset === null || link.preset === current.name ? current : await this.api.preset(link.preset);
      this.controls.set(link.camera ?? cameraFromScene(preset.scene));
      this.clock.jump(link.time ?? preset.time);
      this.clock.setSpeed(link.speed ?? 1);
      if (link.paused !== null) this.clock.playing = !link.paused;
      this.store.set(chosen(preset, link));
      this.fixScale(link.scale);
      this.showAccuracy(link.accuracy === true);
    } catch (error) {
      this.failed(error);
    }
  }

  /** `exact`: with the moment, even while time runs. */
  private link(exact: boolean): LinkState {
    const { preset, scene, quality, auto, split } = this.store.now;
    const moment = exact || (!this.clock.playing && this.clock.time !== preset.time);
    const start = cameraFromScene(preset.scene);
    const { camera } = this.controls;
    return {
      preset: preset.name,
      changes: diff(preset.scene, scene),
      quality: auto ? null : quality,
      time: moment ? this.clock.time : null,
      paused: this.clock.playing ? null : true,
      speed: this.clock.speed,
      camera: !exact && JSON.stringify(camera) === JSON.stringify(start) ? null : camera,
      split,
      scale: this.stage.fixed,
      accuracy: this.accuracyShown ? true : null,
    };
  }

  private tools(): void {
    const tool = (name: IconName, label: string, run: () => void) => {
      const button = element("button", { type: "button", class: "round", "data-tool": name, title: label, "aria-label": label }, icon(name));
      button.addEventListener("click", run);
      return button;
    };
    byId("tools").append(
      tool("compare", "Compare two looks side by side", () => this.toggleSplit()),
      tool("download", "Save the picture as PNG", () => void this.download()),
      tool("link", "Copy a link to exactly this", () => void this.copyLink()),
      tool("accuracy", "What accuracy costs", () => this.showAccuracy(!this.accuracyShown, true)),
      tool("settings", "Settings", () => {
        this.settings.toggle();
        this.loadPane();
        if (this.settings.open) this.showAccuracy(false);
      }),
    );
  }

  /** Shows what accuracy costs, which is loaded when it is first asked for. `focus`: it takes the keyboard. */
  private showAccuracy(shown: boolean, focus = false): void {
    if (shown === this.accuracyShown) return;
    this.accuracyShown = shown;
    this.moved();
    if (shown) this.settings.toggle(false);
    if (this.accuracy) {
      this.accuracy.toggle(shown, focus);
      return;
    }
    import("../accuracy/view").then(
      ({ AccuracyView: View }) => {
        this.accuracy ??= new View(this.api, this.store, this.stage, {
          run: (quality) => this.store.set({ quality, auto: false, split: this.splitWith(QUALITY, quality) }),
          close: () => this.showAccuracy(false),
        });
        this.accuracy.toggle(this.accuracyShown, focus);
      },
      (error: unknown) => {
        this.accuracyShown = false;
        this.failed(error);
      },
    );
  }

  private async download(): Promise<void> {
    try {
      save(await this.stage.png(this.view()), `${this.fileName()}.png`);
    } catch (error) {
      this.failed(error);
    }
  }

  private async serverFrame(): Promise<void> {
    this.settings.rendering(true);
    const { scene, quality } = this.store.now;
    const { width, height } = this.stage.canvas.getBoundingClientRect();
    try {
      const picture = await this.api.frame({
        scene: withValue(scene, CAMERA, { ...this.controls.camera, position: [...this.controls.camera.position] }),
        quality: qualityOf(quality),
        time: this.clock.time,
        width: Math.round(width),
        height: Math.round(height),
      });
      save(picture, `${this.fileName()}-server.png`);
    } catch (error) {
      this.failed(error);
    } finally {
      this.settings.rendering(false);
    }
  }

  private fileName(): string {
    return `seafoam-${this.store.now.preset.name}-${this.clock.time.toFixed(2)}s`;
  }

  private async copyLink(): Promise<void> {
    history.replaceState(null, "", `#${encode(this.link(true))}`);
    try {
      await navigator.clipboard.writeText(location.href);
      this.toasts.show("Link copied: it restores this very picture.");
    } catch {
      this.toasts.show("The browser keeps its clipboard closed; the link is in the address bar.");
    }
  }

  /** Tells the visitor; the old picture stays. Where there is none, the preset as it is takes the place of what was asked for. */
  private failed(error: unknown): void {
    const message = error instanceof Error ? error.message : String(error);
    this.toasts.show(message, error instanceof ApiError ? error.details : [], "error");
    if (this.slots[0].ready !== null) {
      // The old picture stays, and moves again.
      this.still.drop();
      this.live = true;
      return;
    }
    const { preset, scene, quality, split } = this.store.now;
    const refused = error instanceof CapabilityError || (error instanceof ApiError && error.status >= 400 && error.status < 500);
    const plain = equal(scene, preset.scene) && quality === QUALITY_DEFAULT && split === null;
    if (refused && !plain) {
      this.store.set({ scene: preset.scene, quality: QUALITY_DEFAULT, auto: true, split: null });
      return;
    }
    this.curtain.fail("No picture yet", message, "Try again");
    this.settle?.reject(error);
  }

  private hook(): Hook {
    const ready = new Promise<void>((resolve, reject) => (this.settle = { resolve, reject }));
    ready.catch(() => undefined);
    const loser = () => this.stage.gl.getExtension("WEBGL_lose_context");
    let held: WEBGL_lose_context | null = null;
    return {
      ready,
      renderer: this.stage.gpu.capabilities.renderer,
      render: (planOrPreset, options) => renderOffscreen(this.stage.gpu, this.api, planOrPreset, options),
      compile: (plan) => compile(this.stage.gpu, plan),
      loseContext: () => {
        // Once the context is lost, the extension can no longer be asked for.
        held = loser();
        held?.loseContext();
      },
      restoreContext: () => held?.restoreContext(),
      state: () => ({
        ...this.link(true),
        pictures: this.slots.filter(({ ready: picture }) => picture !== null).length,
        lost: this.stage.gl.isContextLost(),
        timing: this.stage.timing(),
        playing: this.clock.playing,
        busy: this.busy.size > 0,
        still: this.still.shown,
        settled: this.busy.size === 0 && !this.still.shown && !this.clock.playing && this.stage.atRest,
      }),
    };
  }
}

/** What a link chooses of a preset. */
function chosen(preset: Preset, link: LinkState): Choices {
  const changed = apply(preset.scene, link.changes);
  const scene = isObject(changed) ? changed : preset.scene;
  const quality = link.quality ?? QUALITY_DEFAULT;
  return { preset, scene, quality, auto: link.quality === null, split: fitting(scene, link.split) };
}

/** A comparison stays only where the scene has the field that is compared. */
function fitting(scene: JsonObject, split: Split | null): Split | null {
  return split && (split.field === QUALITY || typeof get(scene, split.field) === "string") ? split : null;
}

/** Whether a choice is the scene's own, and not of one of a list's items, which are many. */
function isPlain({ field }: Comparable): boolean {
  return field !== QUALITY && steps(field).every((step) => !/^\d+$/.test(step));
}

function save(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  element("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

