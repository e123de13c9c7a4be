/** Automatic quality: the tier and scale of least error within the frame budget, from costs measured ahead. */
import type { Api, TierCost, TierCosts } from "../api";
import type { MovingTier } from "../display/display";
import { allowedAt, bestScale, costAt, type RenderLoad } from "../display/framebudget";
import type { Store } from "../selection/selection";

interface TierChoice {
  tier: string;
  scale: number;
  error: number;
  withinBudget: boolean;
  time: number; // Predicted on this machine, ms a frame
}

/** Another tier is chosen only if its error is smaller by this factor: while its programs compile, slow machines stand still. */
const MIN_IMPROVEMENT = 0.8;
const MUCH_FASTER = 0.7; // Or if it errs no more, and its frames take less than this share of the time

const COARSE = 0.4; // Below this scale a picture is coarse
const FLUENT = 75; // Time of a frame, ms, up to which motion is fluent: worth more than a smaller error

/** What counts against a choice: its error, and by how much its frames are slower than fluent. */
const badness = ({ error, time }: TierChoice) => error * Math.max(1, time / FLUENT);

/** How much more a frame of one preset and tier costs than of another, at a megapixel; 1 where either is not known. */
export function costRatio({ presets }: TierCosts, from: readonly [preset: string, tier: string], to: readonly [preset: string, tier: string]): number {
  const [before, after] = [from, to].map(([preset, tier]) => {
    const cost = presets[preset]?.find((one) => one.tier === tier);
    return cost ? cost.fixed + cost.pixels : null;
  });
  return before && after ? after / before : 1;
}

/** Error at a scale: linear between the measured scales, extrapolated below the least. */
export function errorAt(scales: readonly number[], errors: readonly number[], scale: number): number {
  const index = scales.findIndex((measured) => measured <= scale);
  if (index === 0 || scales.length < 2) return errors[0] ?? Infinity;
  const next = index < 0 ? scales.length - 1 : index;
  const [above, below, errorAbove, errorBelow] = [scales[next - 1], scales[next], errors[next - 1], errors[next]] as [number, number, number, number];
  return errorBelow + ((errorAbove - errorBelow) * (scale - below)) / (above - below);
}

/** For every tier the scale to draw at; the current tier's measured cost calibrates the machine's speed. */
export function tierChoices(tiers: readonly TierCost[], scales: readonly number[], currentTier: string, load: RenderLoad): TierChoice[] {
  const current = tiers.find(({ tier }) => tier === currentTier);
  if (current === undefined) return [];
  const { budget, displayInterval, megapixels } = load;
  // A machine that is not known yet is taken for the one that measured the tiers.
  const measured = load.cost ?? { fixed: current.fixed, pixels: current.pixels * megapixels };
  const slowdown = measured.pixels / (current.pixels * megapixels);
  return tiers.map((tier) => {
    // What else does not shrink with the pixels is the browser's own, which no tier changes.
    const fixed = Math.max(0, measured.fixed + slowdown * (tier.fixed - current.fixed));
    const cost = { fixed, pixels: (measured.pixels * tier.pixels) / current.pixels };
    const scale = bestScale(cost, displayInterval, budget);
    const time = costAt(cost, scale);
    const withinBudget = time <= 1.001 * allowedAt(scale, displayInterval, budget);
    return { tier: tier.tier, scale, error: errorAt(scales, tier.errors, scale), withinBudget, time };
  });
}

/** Switches tiers for one scene. A tier that was left is not selected again, so switching ends. */
export class AutoQuality {
  private readonly rejected = new Set<string>();

  /** The tier to switch to, with its scale; null to stay. */
  next({ presets, scales }: TierCosts, preset: string, currentTier: string, load: RenderLoad): TierChoice | null {
    const choices = tierChoices(presets[preset] ?? [], scales, currentTier, load);
    const current = choices.find(({ tier }) => tier === currentTier);
    if (current === undefined) return null;
    const candidates = choices.filter(({ tier }) => !this.rejected.has(tier));
    const inTime = candidates.filter(({ withinBudget }) => withinBudget);
    // Errors say little of a picture that is too coarse to look at.
    const fine = inTime.filter(({ scale }) => scale >= COARSE);
    const fluent = fine.filter(({ time }) => time <= FLUENT);
    const fitting = [fluent, fine].find(({ length }) => length > 0) ?? inTime;
    // With no tier within budget, the fastest is best.
    const [best] = fitting.length > 0 ? fitting.sort((a, b) => badness(a) - badness(b)) : candidates.sort((a, b) => a.time - b.time);
    if (best === undefined || best.tier === currentTier) return null;
    // What is not measured is not drawn yet: nothing stands still for another.
    const keeps = load.cost !== null && current.withinBudget && (current.scale >= COARSE || fine.length === 0) && (current.time <= FLUENT || fluent.length === 0);
    const faster = best.error <= current.error && best.time < MUCH_FASTER * current.time;
    if (keeps && !faster && badness(best) > MIN_IMPROVEMENT * badness(current)) return null;
    if (load.cost !== null) this.rejected.add(currentTier);
    return best;
  }

  reset(): void {
    this.rejected.clear();
  }
}

/** Switches the selected tier by the measured load. */
export class QualityPilot {
  private readonly choices = new AutoQuality();
  private costs: TierCosts | null | undefined; // Undefined until loaded; null if they cannot be
  private drawn: readonly [string, string] | null = null; // Preset and tier that are drawn; null before the first
  private moving: readonly [string, string] | null = null; // Those of the server's frames in motion
  private readonly movingChoices = new AutoQuality();

  constructor(api: Api, private readonly store: Store) {
    api.tierCosts().then(
      (costs) => (this.costs = costs),
      // Without costs the quality is not switched.
      () => (this.costs = null),
    );
  }

  /** Another scene: tiers that were left may be selected again. */
  reset(): void {
    this.choices.reset();
    this.movingChoices.reset();
  }

  /** `load`: null until it is measured. */
  update(load: RenderLoad | null): void {
    const { preset, quality, auto, split } = this.store.now;
    if (!auto || split !== null || !this.costs || load === null) return;
    const choice = this.choices.next(this.costs, preset.name, quality, load);
    if (choice === null) return;
    this.store.set({ quality: choice.tier });
  }

  /** The tier for frames that the server draws in motion, which the selection does not show; null: as selected. */
  movingTier(load: RenderLoad): MovingTier | null | undefined {
    const { preset, quality, auto, split } = this.store.now;
    if (!auto || split !== null) return null;
    if (!this.costs) return this.costs;
    const before = this.moving?.[0] === preset.name ? this.moving[1] : quality;
    const tier = this.movingChoices.next(this.costs, preset.name, before, load)?.tier ?? before;
    this.moving = [preset.name, tier];
    return { tier, cost: costRatio(this.costs, [preset.name, before], this.moving) };
  }

  /** A plan of the selection is drawn: what its frames cost, as a multiple of the former plan's. */
  planDrawn(): number {
    const { preset, quality } = this.store.now;
    const { drawn } = this;
    this.drawn = [preset.name, quality];
    return this.costs && drawn ? costRatio(this.costs, drawn, this.drawn) : 1;
  }
}
