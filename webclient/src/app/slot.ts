/** One picture on the way to the screen: asks for plans, compiles them in the background, keeps drawing the old one. */
import type { Api } from "../api";
import type { CameraState } from "../camera/state";
import type { FramePlan } from "../generated/api";
import type { Gpu } from "../gl/gpu";
import { CAMERA, serves } from "../plan/live";
import { Executor, type LoadBytes } from "../plan/executor";
import { equal, type Json, withValue } from "../scene/json";

/** Time to wait for a slider to come to rest before the server is asked. */
const DEBOUNCE = 120;

export interface Wanted {
  scene: Json;
  quality: Json;
}

/** A picture that can be drawn. */
export interface Ready {
  executor: Executor;
  /** What the plan was made for. */
  planned: Wanted;
  /** The latest scene that the plan serves; its live fields are drawn. */
  scene: Json;
}

export interface SlotEvents {
  gpu(): Gpu;
  camera(): CameraState;
  /** There is something new to draw; `fresh`: by a new plan. */
  changed(fresh: boolean): void;
  /** The plan serves every camera from now on. */
  whole(): void;
  failed(error: unknown): void;
  /** Whether a plan is on its way. */
  busy(busy: boolean): void;
}

export class Slot {
  ready: Ready | null = null;
  private wanted: Wanted | null = null;
  private request: AbortController | null = null;

  constructor(
    private readonly api: Api,
    private readonly events: SlotEvents,
  ) {}

  get plan(): FramePlan | null {
    return this.ready?.executor.plan ?? null;
  }

  /** Shows this scene: at once where the plan at hand serves it, else as soon as a new one is compiled. */
  show(wanted: Wanted, delay = DEBOUNCE): void {
    const unchanged = this.wanted && equal(this.wanted.scene, wanted.scene) && equal(this.wanted.quality, wanted.quality);
    if (unchanged) return;
    this.wanted = wanted;
    const { ready } = this;
    if (ready && equal(ready.planned.quality, wanted.quality) && serves(ready.executor.plan, ready.planned.scene, wanted.scene)) {
      this.cancel();
      ready.scene = wanted.scene;
      this.events.changed(false);
      return;
    }
    this.load(wanted, delay);
  }

  /** Loads the same picture anew, after the GPU has lost everything. */
  reload(): void {
    this.ready = null;
    if (this.wanted) this.load(this.wanted, 0);
  }

  /** Takes the picture away. */
  clear(): void {
    this.cancel();
    this.wanted = null;
    this.ready?.executor.dispose();
    this.ready = null;
  }

  private cancel(): void {
    this.request?.abort();
    this.request = null;
    this.events.busy(false);
  }

  private load(wanted: Wanted, delay: number): void {
    this.cancel();
    const request = new AbortController();
    this.request = request;
    this.events.busy(true);
    const outdated = () => request.signal.aborted;
    const run = async () => {
      await new Promise((resolve) => setTimeout(resolve, delay));
      if (outdated()) return;
      const gpu = this.events.gpu();
      // One camera for all: the same scene seen from elsewhere is the same plan, and the server's cache knows it.
      const plan = await this.api.plan(withValue(wanted.scene, CAMERA, undefined), wanted.quality, request.signal);
      const bytes: LoadBytes = (texture) => this.api.texture(texture);
      const executor = await Executor.load(gpu, plan, bytes, this.events.camera(), true);
      if (outdated() || gpu !== this.events.gpu()) {
        executor.dispose();
        return;
      }
      this.ready?.executor.dispose();
      this.ready = { executor, planned: wanted, scene: wanted.scene };
      this.request = null;
      this.events.busy(false);
      this.events.changed(true);
      await executor.whole;
      if (this.plan === plan) this.events.whole();
    };
    run().catch((error: unknown) => {
      if (outdated()) return;
      this.request = null;
      // The same scene may be asked for again, once the server is back.
      this.wanted = null;
      this.events.busy(false);
      this.events.failed(error);
    });
  }
}
