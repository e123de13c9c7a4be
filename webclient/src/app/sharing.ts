/** What leaves the page and comes back: pictures with recipes, server frames, and what the surfaces need for them. */
import type { Api } from "../api";
import type { CameraControls } from "../camera/controls";
import type { ChosenDisplay } from "../display/chosendisplay";
import type { PlanLoader } from "../display/planloader";
import { parseQuality } from "../selection/quality";
import type { Store } from "../selection/store";
import { encode } from "../selection/url";
import type { SurfaceContext } from "../surfaces/context";
import type { Recipe } from "../take/recipe";
import { download } from "../ui/dom";
import type { Clock } from "./clock";

/** Greatest side of a frame that the server draws, pixels. */
const MAX_SIDE = 4096;

interface SharingOptions {
  /** Names of all presets. */
  presets: readonly string[];
  copyLink(): Promise<void>;
  failed(error: unknown): void;
}

export class Sharing {
  private readonly listeners = new Set<() => void>();

  constructor(
    private readonly api: Api,
    private readonly store: Store,
    private readonly clock: Clock,
    private readonly controls: CameraControls,
    private readonly display: ChosenDisplay,
    private readonly loaders: readonly [PlanLoader, PlanLoader],
    private readonly options: SharingOptions,
  ) {
    store.onChange(() => this.notify());
    clock.onChange(() => this.notify());
    controls.onMove(() => this.notify());
  }

  planChanged(): void {
    this.notify();
  }

  private notify(): void {
    for (const listener of this.listeners) listener();
  }

  /** The current view in a size. */
  private view(width: number, height: number): Omit<Recipe, "recipe" | "seafoam"> {
    const { preset, scene, quality, split } = this.store.now;
    const renderer = this.display.gpu?.capabilities.renderer ?? "server";
    const { camera } = this.controls;
    const fit = (side: number) => Math.max(1, Math.min(MAX_SIDE, Math.round(side)));
    const [fittingWidth, fittingHeight] = [fit(width), fit(height)];
    return {
      renderer,
      preset: preset.name,
      scene,
      quality: parseQuality(quality),
      camera,
      time: this.clock.time,
      width: fittingWidth,
      height: fittingHeight,
      split,
    };
  }

  /** The picture as PNG at full size, with its recipe. */
  async png(): Promise<Blob> {
    const { viewport } = this.display;
    if (viewport === null) return this.serverFrame();
    const { time } = this.clock;
    const { camera } = this.controls;
    await Promise.all(this.loaders.map((loader) => loader.exact()));
    const image = viewport.png({ time, camera, divider: this.store.now.split?.at ?? 1 });
    const { width, height } = viewport.canvas;
    const view = { ...this.view(width, height), time, camera };
    const { recipeOf, withRecipe } = await import("../take/recipe");
    return withRecipe(await image, recipeOf(view));
  }

  /** The view drawn by the server, at the window's size. */
  async serverFrame(): Promise<Blob> {
    const { width, height } = this.display.canvas.getBoundingClientRect();
    const view = this.view(width, height);
    const [{ recipeOf }, { exactFrame }] = await Promise.all([import("../take/recipe"), import("../take/snippets")]);
    return this.api.frame(exactFrame(recipeOf(view)));
  }

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

  /** What surfaces know and can do. */
  async context(close: () => void): Promise<SurfaceContext> {
    const { recipeOf } = await import("../take/recipe");
    return {
      api: this.api,
      viewport: () => this.display.viewport,
      selection: () => this.store.now,
      plan: () => this.loaders[0].plan,
      executor: () => this.loaders[0].loaded?.executor ?? null,
      time: () => this.clock.time,
      camera: () => this.controls.camera,
      playing: () => this.clock.playing,
      recipe: () => {
        const { width, height } = this.display.canvas.getBoundingClientRect();
        return recipeOf(this.view(width, height));
      },
      png: () => this.png(),
      save: (image, suffix) => this.save(image, suffix),
      copyLink: () => this.options.copyLink(),
      restore: (file) => this.restore(file),
      failed: (error) => this.options.failed(error),
      onChange: (listener) => {
        this.listeners.add(listener);
        return () => this.listeners.delete(listener);
      },
      close,
    };
  }
}
