/** Selects quality tier and scale together: the least error within the frame budget, from costs measured ahead. */
import { budgetAt, type FrameBudget, MIN_SCALE } from "./resolution";

/** Cost and error of one tier, as `make fronts` measured them. */
export interface TierCost {
  tier: string;
  /** ms a frame at any size, on the measuring machine. */
  fixed: number;
  /** ms a megapixel. */
  pixels: number;
  /** RMSE at each of the scales, largest scale first, levels of 255. */
  errors: readonly number[];
}

export interface TierCosts {
  scales: readonly number[];
  presets: Readonly<Record<string, readonly TierCost[]>>;
}

/** Measured load of this machine, with the current tier. */
export interface RenderLoad {
  budget: FrameBudget;
  scale: number;
  /** ms a frame. */
  renderTime: number;
  /** Time between frames that is not render time, ms. */
  overhead: number;
  /** At scale 1. */
  megapixels: number;
}

export interface TierChoice {
  tier: string;
  scale: number;
  error: number;
  withinBudget: boolean;
  /** Predicted on this machine, ms a frame. */
  time: number;
}

/** Another tier is chosen only if its error is smaller by this factor. */
const MIN_IMPROVEMENT = 0.93;
const SCALE_STEPS = 60;

const costOf = ({ fixed, pixels }: TierCost, megapixels: number, scale: number) => fixed + pixels * megapixels * scale ** 2;

/** Error at a scale: linear between the measured scales, extrapolated below the least. */
export function errorAt(scales: readonly number[], errors: readonly number[], scale: number): number {
  const index = scales.findIndex((measured) => measured <= scale);
  if (index === 0 || scales.length < 2) return errors[0] ?? Infinity;
  const next = index < 0 ? scales.length - 1 : index;
  const [above, below, errorAbove, errorBelow] = [scales[next - 1], scales[next], errors[next - 1], errors[next]] as [number, number, number, number];
  return errorBelow + ((errorAbove - errorBelow) * (scale - below)) / (above - below);
}

/** For every tier the greatest scale within budget; the current tier's render time calibrates the machine's speed. */
export function tierChoices(tiers: readonly TierCost[], scales: readonly number[], currentTier: string, load: RenderLoad): TierChoice[] {
  const current = tiers.find(({ tier }) => tier === currentTier);
  if (current === undefined) return [];
  const slowdown = load.renderTime / costOf(current, load.megapixels, load.scale);
  return tiers.map((cost) => {
    const timeAt = (scale: number) => load.overhead + slowdown * costOf(cost, load.megapixels, scale);
    const fits = (scale: number) => timeAt(scale) <= budgetAt(load.budget, scale);
    let scale = MIN_SCALE;
    for (let step = 1; step <= SCALE_STEPS; step++) {
      const candidate = MIN_SCALE + ((1 - MIN_SCALE) * step) / SCALE_STEPS;
      if (fits(candidate)) scale = candidate;
    }
    return { tier: cost.tier, scale, error: errorAt(scales, cost.errors, scale), withinBudget: fits(scale), time: timeAt(scale) };
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
    const fitting = candidates.filter(({ withinBudget }) => withinBudget);
    // With no tier within budget, the fastest is best.
    const [best] = fitting.length > 0 ? fitting.sort((a, b) => a.error - b.error) : candidates.sort((a, b) => a.time - b.time);
    if (best === undefined || best.tier === currentTier) return null;
    if (current.withinBudget && best.error > MIN_IMPROVEMENT * current.error) return null;
    this.rejected.add(currentTier);
    return best;
  }

  reset(): void {
    this.rejected.clear();
  }
}
