/** The page as its tools and surfaces know it: its parts, the current view, and how pictures leave it and come back. */
import type { Api } from "../api";
import type { Clock } from "../app/transport";
import type { CameraControls } from "../camera/controls";
import type { ChosenDisplay } from "../display/chosendisplay";
import type { PlanLoader } from "../display/planloader";
import type { FramePlan } from "../generated/api";
import type { Executor } from "../plan/executor";
import { parseQuality, type Store } from "../selection/selection";
import { encode } from "../selection/url";
import type { RecipeParts } from "../take/recipe";
import { download } from "../ui/dom";

const MAX_SIDE = 4096; // Greatest side of a frame that the server draws, pixels

interface PageOptions {
  presets: readonly string[]; // Names of all presets
  copyLink: () => Promise<void>;
  failed: (error: unknown) => void;
  /** Closes the open surface. */
  close: () => void;
}

export class PageContext {
  private readonly listeners = new Set<() => void>();

  constructor(
    readonly api: Api,
    readonly store: Store,
    readonly clock: Clock,
    readonly controls: CameraControls,
    readonly display: ChosenDisplay,
    private readonly loaders: readonly [PlanLoader, PlanLoader],
    readonly options: PageOptions,
  ) {
    store.onChange(() => this.changed());
    clock.onChange(() => this.changed());
    controls.onMove(() => this.changed());
    listenForDrops((file) => void this.restore(file).catch(options.failed));
  }

  /** Calls back when selection, plan, time or camera change, not in every frame of motion; returns what ends that. */
  onChange(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  changed(): void {
    for (const listener of this.listeners) listener();
  }

  /** Plan of the picture, or of its left part; null until loaded. */
  get plan(): FramePlan | null { return this.loaders[0].plan; }

  /** What draws the plan; null until loaded, and where the server draws. */
  get executor(): Executor | null { return this.loaders[0].loaded?.executor ?? null; }

  /** The current view in a size; by default the window's. */
  view({ width, height }: { width: number; height: number } = this.display.current.canvas.getBoundingClientRect()): RecipeParts {
    const { preset, scene, quality, split } = this.store.now;
    const fit = (side: number) => Math.max(1, Math.min(MAX_SIDE, Math.round(side)));
    return {
      renderer: this.display.current.gpu?.capabilities.renderer ?? "server",
      preset: preset.name,
      scene,
      quality: parseQuality(quality),
      camera: this.controls.camera,
      time: this.clock.time,
      width: fit(width),
      height: fit(height),
      split,
    };
  }

  /** The picture as PNG at full size, with its recipe. */
  async png(): Promise<Blob> {
    const { viewport } = this.display;
    if (viewport === null) return this.serverFrame();
    const { time } = this.clock;
    const { camera } = this.controls;
    await Promise.all(this.loaders.map((loader) => loader.exact));
    const image = viewport.png({ time, camera, divider: this.store.now.split?.at ?? 1 });
    const view = { ...this.view(viewport.canvas), time, camera };
    const { recipeOf, withRecipe } = await import("../take/recipe");
    return withRecipe(await image, recipeOf(view));
  }

  /** The view drawn by the server, at the window's size. */
  async serverFrame(): Promise<Blob> {
    const view = this.view();
    const { exactFrame } = await import("../take/recipe");
    return this.api.frame(exactFrame(view));
  }

  /** Saves a picture under the name of the preset and the time. */
  async save(image: Promise<Blob>, suffix: string): Promise<void> {
    const name = `seafoam-${this.store.now.preset.name}-${this.clock.time.toFixed(2)}s${suffix}.png`;
    try {
      download(await image, name);
    } catch (error) {
      this.options.failed(error);
    }
  }

  /** Opens the view that a picture's recipe describes; throws a `RecipeError` if it has none. */
  async restore(file: Blob): Promise<void> {
    const { readRecipe, linkOf } = await import("../take/recipe");
    const recipe = await readRecipe(file);
    const { preset: current } = this.store.now;
    const known = recipe.preset !== null && this.options.presets.includes(recipe.preset) ? recipe.preset : current.name;
    const preset = known === current.name ? current : await this.api.preset(known);
    location.hash = encode(linkOf(recipe, preset));
  }
}

/** Calls `restore` with each picture that is dropped on the page; other files and texts are left to the browser. */
function listenForDrops(restore: (file: File) => void): void {
  const hasFile = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  window.addEventListener("dragover", (event) => {
    // Without this the browser opens the file.
    if (hasFile(event)) event.preventDefault();
  });
  window.addEventListener("drop", (event) => {
    if (!hasFile(event)) return;
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (file) restore(file);
  });
}
