/** Requests the plan of a scene and compiles it in the background, while the previous plan is drawn. */
import type { Api } from "../api";
import type { CameraState } from "../camera/state";
import type { FramePlan } from "../generated/api";
import type { Gpu } from "../gl/gpu";
import { Executor } from "../plan/executor";
import { CAMERA_POINTER, planCovers } from "../plan/rules";
import type { TextureParts } from "../plan/textureparts";
import { equal, type Json, withValue } from "../scene/json";

const DEBOUNCE = 120; // Delay before the server is asked, ms: a slider may still move

export interface PlanRequest { scene: Json; quality: Json; }

interface LoadedPlan {
  plan: FramePlan;
  executor: Executor | null; // Null where the server draws
  request: PlanRequest;
  scene: Json; // The latest scene that the plan covers; its live fields are drawn
}

/** What a picture shows. */
export type PlanView = Pick<LoadedPlan, "scene" | "request">;

interface PlanLoaderEvents {
  decided(): Promise<void>; // Settles when it is known who draws
  gpu(): Gpu | null; // Null where the server draws
  camera(): CameraState;
  /** Settles when the first picture is shown: until then textures may be rough. Null: they must be exact. */
  roughUntil(): Promise<void> | null;
  changed(newPlan: boolean): void; // There is something new to draw; `newPlan`: not only live fields
  complete(): void; // The programs for every camera are compiled
  failed(error: unknown): void;
  busy(busy: boolean): void;
}

export class PlanLoader {
  loaded: LoadedPlan | null = null;
  private requested: PlanRequest | null = null;
  private abort: AbortController | null = null;
  /** Settles when the picture has exact textures; rejects if what that takes could not be loaded. */
  exact: Promise<void> = Promise.resolve();

  constructor(private readonly api: Api, private readonly textures: TextureParts, private readonly events: PlanLoaderEvents) {}

  /** Whether the picture is not exact yet. */
  get rough(): boolean { return this.loaded?.executor?.rough === true; }

  /** What is drawn, or before the first plan is there what will be. */
  get view(): PlanView | null {
    const { loaded, requested } = this;
    return loaded ?? (requested && { scene: requested.scene, request: requested });
  }

  get plan(): FramePlan | null { return this.loaded?.plan ?? null; }

  /** Shows a scene: at once if the loaded plan covers it, else when a new plan is compiled. */
  show(request: PlanRequest, delay = DEBOUNCE): void {
    if (this.requested && equal(this.requested.scene, request.scene) && equal(this.requested.quality, request.quality)) return;
    this.requested = request;
    const { loaded } = this;
    if (loaded && equal(loaded.request.quality, request.quality) && planCovers(loaded.plan, loaded.request.scene, request.scene)) {
      this.cancel();
      loaded.scene = request.scene;
      this.events.changed(false);
      return;
    }
    this.load(request, delay);
  }

  /** Loads the same plan again, after a lost context. */
  reload(): void {
    this.loaded = null;
    if (this.requested) this.load(this.requested, 0);
  }

  clear(): void {
    this.cancel();
    this.requested = null;
    this.loaded?.executor?.dispose();
    this.loaded = null;
  }

  private cancel(): void {
    this.abort?.abort();
    this.abort = null;
    this.events.busy(false);
  }

  private load(request: PlanRequest, delay: number): void {
    this.cancel();
    const abort = new AbortController();
    this.abort = abort;
    this.events.busy(true);
    const outdated = () => abort.signal.aborted;
    const run = async () => {
      await new Promise((resolve) => setTimeout(resolve, delay));
      if (outdated()) return;
      // Without its camera, so that the server's cache has one plan for every view of the scene.
      const scene = withValue(request.scene, CAMERA_POINTER, undefined);
      const [plan] = await Promise.all([this.api.plan(scene, request.quality, abort.signal), this.events.decided()]);
      const gpu = this.events.gpu();
      const roughUntil = this.events.roughUntil();
      const executor = gpu && await Executor.load(gpu, plan, this.textures.exact, this.events.camera(), true, roughUntil && this.textures.roughOf(plan));
      if (!outdated()) await executor?.warmUp(this.events.camera(), request.scene);
      if (outdated() || gpu !== this.events.gpu()) {
        executor?.dispose();
        return;
      }
      this.loaded?.executor?.dispose();
      const loaded = { plan, executor, request, scene: request.scene };
      this.loaded = loaded;
      this.abort = null;
      this.exact = gpu && executor?.rough && roughUntil ? roughUntil.then(() => this.refine(gpu, loaded)) : Promise.resolve();
      this.exact.catch((error: unknown) => {
        if (this.loaded === loaded) this.events.failed(error);
      });
      this.events.busy(false);
      this.events.changed(true);
      await executor?.complete;
      if (this.plan === plan) this.events.complete();
    };
    run().catch((error: unknown) => {
      if (outdated()) return;
      this.abort = null;
      // The same scene may be requested again.
      this.requested = null;
      this.events.busy(false);
      this.events.failed(error);
    });
  }

  /** Puts exact textures in the place of rough ones: by an executor of its own, whose tables are drawn where nobody sees it. */
  private async refine(gpu: Gpu, loaded: LoadedPlan): Promise<void> {
    const outdated = () => this.loaded !== loaded;
    if (outdated()) return;
    const executor = await Executor.load(gpu, loaded.plan, this.textures.exact, this.events.camera(), true);
    if (!outdated()) await executor.warmUp(this.events.camera(), loaded.scene, true);
    if (outdated()) {
      executor.dispose();
      return;
    }
    loaded.executor?.dispose();
    loaded.executor = executor;
    this.events.changed(false);
    void executor.complete.then(() => outdated() || this.events.complete());
  }
}
