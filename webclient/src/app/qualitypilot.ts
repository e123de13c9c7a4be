/** Automatic quality: switches the tier by the measured load, from costs that the server measured ahead. */
import type { Api } from "../api";
import { AutoQuality, type RenderLoad, type TierCosts } from "./autoquality";
import type { Store } from "./store";

export class QualityPilot {
  private readonly choices = new AutoQuality();
  /** Null until loaded. */
  private costs: TierCosts | null = null;
  /** Predicted scale of the quality that was selected last. */
  private expectedScale: number | null = null;

  constructor(
    private readonly api: Api,
    private readonly store: Store,
  ) {}

  loadCosts(): void {
    if (this.costs !== null) return;
    this.api.tierCosts().then(
      (costs) => (this.costs = costs),
      // Without costs the quality is not switched.
      () => undefined,
    );
  }

  /** Another scene: tiers that were left may be selected again. */
  reset(): void {
    this.choices.reset();
  }

  /** `load`: null until it is measured. */
  update(load: RenderLoad | null): void {
    const { preset, quality, auto, split } = this.store.now;
    if (!auto || split !== null || this.costs === null || load === null) return;
    const choice = this.choices.next(this.costs, preset.name, quality, load);
    if (choice === null) return;
    this.expectedScale = choice.scale;
    this.store.set({ quality: choice.tier });
  }

  /** The scale to begin the new plan with, once; null if none was predicted. */
  takeScale(): number | null {
    const scale = this.expectedScale;
    this.expectedScale = null;
    return scale;
  }
}
