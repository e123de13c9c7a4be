/** The page: connects the user's selection to what is drawn. */
import { type Api, ApiError, messageOf, type Preset, type PresetSummary } from "../api";
import { CameraControls, CLEARANCE } from "../camera/controls";
import { cameraFromScene } from "../camera/state";
import type { ChosenDisplay, MakeDisplay } from "../display/chosendisplay";
import type { FrameSourceChoice } from "../display/display";
import { PlanLoader } from "../display/planloader";
import { SceneEdits } from "../edits/edits";
import { Gallery } from "../gallery/gallery";
import { CapabilityError } from "../gl/capabilities";
import { TextureParts } from "../plan/textureparts";
import { equal } from "../scene/json";
import { DEFAULT_TIER, planRequest, QUALITY_FIELD, qualityTitle, type Selection, splitAfterEdit, Store, validSplit } from "../selection/selection";
import { type LinkState, selectionFromLink } from "../selection/url";
import { PageContext } from "../surfaces/context";
import { Surfaces } from "../surfaces/surfaces";
import { makeTestHook } from "../testhook";
import { TouchTool } from "../touch/tool";
import { byId, prefersReducedMotion } from "../ui/dom";
import { Clock, FrameStats, Transport } from "./transport";
import { type LoadingScreen, showHint, Toasts } from "../ui/overlays";
import { SettingsPanel } from "../ui/settings/settings";
import type { StillImage } from "../ui/still";
import { AccuracyTool } from "./accuracytool";
import { Address, PresetLoader } from "./address";
import { QualityPilot } from "./autoquality";
import { SceneEditor } from "./sceneeditor";
import { addTools, copyLink, type PageParts } from "./tools";

const STATS_INTERVAL = 250;

/** The way to server frames from a page that cannot draw. */
function serverLink(): { text: string; href: string } {
  const url = new URL(location.href);
  url.hash = `${url.hash.replace(/^#?/, "#")}&draw=server`;
  return { text: "Show frames drawn by the server", href: url.href };
}

export class App implements PageParts {
  readonly toasts = new Toasts(byId("toasts"));
  readonly settings: SettingsPanel;
  readonly editor: SceneEditor;
  readonly accuracy: AccuracyTool;
  readonly surfaces: Surfaces;
  readonly context: PageContext;
  readonly address: Address;
  readonly touch: TouchTool;
  private readonly clock = new Clock();
  private readonly stats = new FrameStats();
  private readonly store: Store;
  private readonly textures: TextureParts;
  private readonly loaders: readonly [PlanLoader, PlanLoader];
  private readonly display: ChosenDisplay;
  private readonly controls: CameraControls;
  private readonly gallery: Gallery;
  private readonly transport: Transport;
  private readonly busy = new Set<0 | 1 | "preset">(); // Sides whose plan is loading, and the preset that does
  private readonly presetLoader: PresetLoader;
  private lastTick = 0;
  private readonly pilot: QualityPilot;
  /** Whether the selected preset has been drawn: until then its still covers the canvas and time stands. */
  private started = false;
  private moved = false; // Whether any preset has been drawn
  private readonly ready: Promise<void>;
  private resolveReady: () => void = () => undefined;
  private rejectReady: (error: unknown) => void = () => undefined;
  /** Settles when a picture is shown by who draws for good: measurements of the first frames are done. */
  private readonly drawn: Promise<void>;
  private resolveDrawn: () => void = () => undefined;

  constructor(
    private readonly api: Api,
    private readonly loadingScreen: LoadingScreen,
    private readonly still: StillImage,
    { presets, preset, link, makeDisplay }: { presets: readonly PresetSummary[]; preset: Preset; link: LinkState; makeDisplay: MakeDisplay },
  ) {
    const reducedMotion = prefersReducedMotion();
    this.store = new Store(selectionFromLink(preset, link));
    this.clock.seek(link.time ?? preset.time);
    this.clock.setSpeed(link.speed ?? 1);
    this.clock.playing = !(link.paused ?? reducedMotion);

    const canvas = byId("canvas") as HTMLCanvasElement;
    this.textures = new TextureParts(api.texture);
    this.loaders = [this.makeLoader(0), this.makeLoader(1)];
    this.presetLoader = new PresetLoader(api, () => this.store.now.preset, (busy) => this.setBusy("preset", busy));
    this.pilot = new QualityPilot(api, this.store);
    this.display = this.connect(makeDisplay);
    this.display.setFixedScale(link.scale);
    this.display.choose(link.draw ?? "auto");
    this.controls = new CameraControls(canvas, link.camera ?? cameraFromScene(preset.scene), !reducedMotion);
    this.settings = this.makeSettings();
    this.settings.showSource(this.display.choice, this.display.browser !== null);
    this.editor = new SceneEditor(api, this.store, this.settings.scene, byId("split-view"), {
      tiers: (names) => {
        const { quality, auto } = this.store.now;
        this.settings.show(quality, auto, names);
      },
      failed: this.failed,
    });
    this.accuracy = this.makeAccuracyTool();
    this.context = new PageContext(api, this.store, this.clock, this.controls, this.display, this.loaders, {
      presets: presets.map(({ name }) => name),
      copyLink: () => copyLink(this),
      failed: this.failed,
      close: () => this.surfaces.show(null),
    });
    this.surfaces = new Surfaces(this.context, {
      toggled: (open) => {
        this.viewChanged();
        if (open === null) return;
        this.settings.toggle(false);
        this.accuracy.toggle(false);
      },
      failed: this.failed,
    });
    this.address = new Address(this.store, this.clock, this.controls, this.display, this.accuracy, this.surfaces);
    this.gallery = new Gallery(byId("gallery"), byId("water-list"), presets, (name) => void this.choosePreset(name));
    this.transport = new Transport(byId("transport"), this.clock, () => this.store.now.preset.time, this.stats.root);
    new SceneEdits(this.settings.edits, api, this.store, {
      pasted: (scene) => this.controls.set(cameraFromScene(scene)),
      note: (text) => this.toasts.show(text),
    });
    this.touch = new TouchTool(canvas, this.store, this.clock, this.controls, {
      plan: () => this.loaders[0].plan,
      busy: () => this.busy.size > 0,
      refused: (why) => this.toasts.show(`This picture shows no rings: ${why}.`),
    });
    this.ready = new Promise((resolve, reject) => {
      this.resolveReady = resolve;
      this.rejectReady = reject;
    });
    this.ready.catch(() => undefined);
    this.drawn = new Promise((resolve) => (this.resolveDrawn = resolve));
    addTools(this);
    this.accuracy.toggle(link.accuracy === true);
    this.surfaces.show(link.surface);
    this.settings.toggle(false);
    this.listen();
    window.seafoam = makeTestHook(api, this.display.browser, this.ready, () => this.testState());
    this.showSelection(this.store.now);
    this.requestPlans(0);
    requestAnimationFrame((now) => this.tick(now));
  }

  /** Shows an error. The previous picture stays; if there is none, the unedited preset is tried. */
  readonly failed = (error: unknown): void => {
    const message = messageOf(error);
    this.toasts.show(message, error instanceof ApiError ? error.details : [], "error");
    if (!this.display.blank) {
      this.still.hide();
      this.gallery.pictures.value = true;
      this.started = true;
      return;
    }
    const { preset, scene, quality, split } = this.store.now;
    const unsupported = error instanceof CapabilityError || (error instanceof ApiError && error.status >= 400 && error.status < 500);
    const unedited = equal(scene, preset.scene) && quality === DEFAULT_TIER && split === null;
    if (unsupported && !unedited) {
      this.store.set({ scene: preset.scene, quality: DEFAULT_TIER, auto: true, split: null });
      return;
    }
    if (this.display.browser === null) this.loadingScreen.fail("Server error", message);
    else this.loadingScreen.fail("Rendering failed", message, serverLink());
    this.rejectReady(error);
  };

  private makeLoader(index: 0 | 1): PlanLoader {
    return new PlanLoader(this.api, this.textures, {
      decided: () => this.display.decide(this.clock.playing),
      gpu: () => this.display.current.gpu,
      camera: () => this.controls.camera,
      // A picture that stands, or beside another, can be looked at closely.
      roughUntil: () => (this.moved || !this.clock.playing || this.store.now.split !== null ? null : this.drawn),
      complete: () => this.limitCamera(),
      changed: (newPlan) => {
        if (newPlan) this.planChanged();
        this.display.invalidate();
      },
      failed: this.failed,
      busy: (busy) => this.setBusy(index, busy),
    });
  }

  private setBusy(task: 0 | 1 | "preset", busy: boolean): void {
    if (busy) this.busy.add(task);
    else this.busy.delete(task);
    this.settings.setBusy(this.busy.size > 0);
  }

  private connect(makeDisplay: MakeDisplay): ChosenDisplay {
    return makeDisplay(this.loaders, {
      contextLost: () => this.toasts.show("WebGL context lost. Rendering resumes when the browser restores it."),
      contextRestored: () => this.loaders.forEach((loader) => loader.reload()),
      failed: this.failed,
      frameDone: () => this.frameDone(),
      sourceChanged: () => this.sourceChanged(),
      movingTier: (load) => this.pilot.movingTier(load),
    });
  }

  private makeSettings(): SettingsPanel {
    return new SettingsPanel(byId("settings"), this.controls, {
      quality: (tier) => this.setQuality(tier ?? this.store.now.quality, tier === null),
      source: (choice) => this.chooseSource(choice),
      scale: (scale) => this.setFixedScale(scale),
      reset: () => this.openPreset(this.store.now.preset),
      serverFrame: () => void this.saveServerFrame(),
    });
  }

  private makeAccuracyTool(): AccuracyTool {
    return new AccuracyTool(this.api, this.store, this.display.viewport, {
      selectQuality: (quality) => this.setQuality(quality, false),
      toggled: (open) => {
        this.viewChanged();
        if (!open) return;
        this.settings.toggle(false);
        this.surfaces.show(null);
      },
      failed: this.failed,
    });
  }

  private setQuality(quality: string, auto: boolean): void {
    this.store.set({ quality, auto, split: splitAfterEdit(this.store.now.split, QUALITY_FIELD, quality) });
  }

  private listen(): void {
    this.store.onChange((now) => {
      this.showSelection(now);
      this.requestPlans();
      this.viewChanged();
    });
    this.clock.onChange(() => this.viewChanged());
    this.controls.onMove(() => {
      this.still.hide();
      this.viewChanged();
    });
    this.address.onVisit((link) => void this.followLink(link));
    setInterval(() => {
      const { quality, auto } = this.store.now;
      const { source, why, current } = this.display;
      const timing = this.display.timing();
      this.stats.show({ ...timing, source, why, stalled: current.stalled !== null, playing: this.clock.playing, quality: qualityTitle(timing.tier ?? quality), auto });
      // Under the still the server may yet draw: it is asked for when this browser's first frames are measured.
      if (this.started) this.pilotQuality();
      if (this.clock.playing) this.transport.update();
    }, STATS_INTERVAL);
  }

  private tick(now: number): void {
    requestAnimationFrame((next) => this.tick(next));
    const seconds = this.lastTick === 0 ? 0 : (now - this.lastTick) / 1000;
    this.lastTick = now;
    const cameraMoved = this.controls.step(seconds);
    if (this.started && this.display.current.stalled === null) this.clock.advance(seconds);
    // Under the still frames are measured, while time stands.
    const view = { time: this.clock.time, camera: this.controls.camera, divider: this.store.now.split?.at ?? 1 };
    this.display.tick(now, view, cameraMoved || this.clock.playing);
  }

  private frameDone(): void {
    if (this.clock.playing) this.transport.movePosition();
    if (!this.display.presentable) return;
    if (!this.display.bridged) this.resolveDrawn();
    if (this.started) return;
    this.pilotQuality();
    if (this.busy.has(0) && !this.display.bridged) return;
    this.started = true;
    this.still.fadeOut();
    this.loadingScreen.hide();
    if (this.moved) return;
    this.moved = true;
    showHint(byId("bar"), matchMedia("(pointer: coarse)").matches);
    this.gallery.pictures.value = true;
    this.resolveReady();
  }

  private pilotQuality(): void {
    if (this.clock.playing && this.busy.size === 0) this.pilot.update(this.display.viewport?.load() ?? null);
  }

  private viewChanged(): void {
    this.display.invalidate();
    this.address.scheduleUpdate();
  }

  private requestPlans(delay?: number): void {
    const { now } = this.store;
    const [left, right] = this.loaders;
    left.show(planRequest(now, "left"), delay);
    if (now.split) right.show(planRequest(now, "right"), delay);
    else right.clear();
  }

  private planChanged(): void {
    this.settings.effects.show(this.loaders[0].plan);
    this.context.changed();
    this.limitCamera();
    this.touch.planChanged();
    this.display.planChanged(this.pilot.planDrawn());
  }

  /** Limits the camera's height: below the surface only if the programs for it are compiled. */
  private limitCamera(): void {
    const { loaded } = this.loaders[0];
    if (loaded === null) return;
    const { plan, executor } = loaded;
    const underwater = plan.passes.some((pass) => pass.eye.includes("under")) && (["between", "under"] as const).every((eye) => executor?.isReadyFor(eye) !== false);
    this.controls.surface = plan.top + CLEARANCE;
    this.controls.bottom = underwater ? plan.bottom + CLEARANCE : this.controls.surface;
  }

  private showSelection({ preset, quality, auto }: Selection): void {
    byId("title").textContent = preset.title;
    // Not by :has(:empty), which WebKit does not look at again.
    byId("heading").classList.remove("unnamed");
    for (const tone of ["pale", "uneven"]) byId("heading").classList.toggle(tone, document.documentElement.dataset[tone]?.split(" ").includes(preset.name) === true);
    byId("summary").textContent = preset.summary;
    document.title = `${preset.title} · Seafoam`;
    this.gallery.select(preset.name);
    this.settings.show(quality, auto);
    this.editor.show();
  }

  private async choosePreset(name: string): Promise<void> {
    const { preset: current } = this.store.now;
    try {
      const loading = this.loadPreset(name);
      if (name !== current.name) this.still.show(name);
      const preset = await loading;
      if (preset === null || preset === current) return;
      this.started = false;
      this.address.startEntry();
      this.openPreset(preset);
    } catch (error) {
      this.still.hide();
      this.failed(error);
    }
  }

  /** Instead of a preset that was chosen, but is not there yet; its still goes. */
  private loadPreset(name: string): Promise<Preset | null> {
    if (this.started) this.still.hide();
    return this.presetLoader.load(name);
  }

  private chooseSource(choice: FrameSourceChoice): void {
    this.display.choose(choice);
    this.settings.showSource(choice, this.display.browser !== null);
    this.viewChanged();
  }

  /** Plans that were loaded while the server drew have no programs. */
  private sourceChanged(): void {
    if (this.display.current.gpu === null) return;
    for (const loader of this.loaders) if (loader.loaded?.executor === null) loader.reload();
  }

  private setFixedScale(scale: number | null): void {
    this.display.setFixedScale(scale);
    this.settings.showScale(scale);
    this.viewChanged();
  }

  private openPreset(preset: Preset): void {
    this.controls.set(cameraFromScene(preset.scene));
    this.clock.seek(preset.time);
    this.pilot.reset();
    this.store.set({ preset, scene: preset.scene, split: validSplit(preset.scene, this.store.now.split) });
  }

  private async followLink(link: LinkState): Promise<void> {
    try {
      const preset = await this.loadPreset(link.preset ?? this.store.now.preset.name);
      if (preset === null) return;
      this.controls.set(link.camera ?? cameraFromScene(preset.scene));
      this.clock.seek(link.time ?? preset.time);
      this.clock.setSpeed(link.speed ?? 1);
      if (link.paused !== null) this.clock.playing = !link.paused;
      this.store.set(selectionFromLink(preset, link));
      this.setFixedScale(link.scale);
      this.chooseSource(link.draw ?? "auto");
      this.accuracy.toggle(link.accuracy === true);
      this.surfaces.show(link.surface);
    } catch (error) {
      this.failed(error);
    }
  }

  private async saveServerFrame(): Promise<void> {
    this.settings.setRendering(true);
    await this.context.save(this.context.serverFrame(), "-server");
    this.settings.setRendering(false);
  }

  private testState() {
    return {
      ...this.address.link(true),
      rough: this.loaders[0].rough,
      pictures: this.loaders.filter(({ loaded }) => loaded !== null).length,
      lost: this.display.current.gpu?.gl.isContextLost() ?? false,
      timing: this.display.timing(),
      playing: this.clock.playing,
      busy: this.busy.size > 0,
      still: this.still.shown,
      settled: this.busy.size === 0 && !this.loaders[0].rough && !this.still.shown && !this.clock.playing && this.display.current.atRest,
    };
  }
}
