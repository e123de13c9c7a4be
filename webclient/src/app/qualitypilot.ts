/** Automatic quality: switches the tier by the measured load, from costs that the server measured ahead. */
import type { Api } from "../api";
import type { RenderLoad } from "../display/framebudget";
import type { Store } from "../selection/store";
import { AutoQuality, costRatio, type TierCosts } from "./autoquality";

export class QualityPilot {
  private readonly choices = new AutoQuality();
  /** Null until loaded. */
  private costs: TierCosts | null = null;
  /** Preset and tier that are drawn; null before the first. */
  private drawn: readonly [string, string] | null = null;

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
    this.store.set({ quality: choice.tier });
  }

  /** A plan of the selection is drawn: what its frames cost, as a multiple of the former plan's. */
  planDrawn(): number {
    const { preset, quality } = this.store.now;
    const { drawn } = this;
    this.drawn = [preset.name, quality];
    return this.costs && drawn ? costRatio(this.costs, drawn, this.drawn) : 1;
  }
}
