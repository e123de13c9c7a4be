/** Chooses quality and scale together, from what was measured of every tier: which picture is nearest to the truth in time. */
import { allowed, LEAST, type Law } from "./pace";

/** What one tier costs and is worth, as `make fronts` measured it. */
export interface TierCost {
  tier: string;
  /** ms of a frame, whatever its size, and of a million pixels; on that machine. */
  fixed: number;
  pixels: number;
  /** RMSE in levels at each of the scales, the largest first. */
  errors: readonly number[];
}

export interface Fronts {
  scales: readonly number[];
  presets: Readonly<Record<string, readonly TierCost[]>>;
}

/** What a picture in motion takes here. */
export interface Pacing {
  law: Law;
  scale: number;
  /** ms of a frame's water, and of all else from one frame to the next. */
  water: number;
  rest: number;
  /** Pixels of the whole window, millions. */
  pixels: number;
}

export interface Choice {
  tier: string;
  scale: number;
  error: number;
  /** Whether it keeps the law: where even the least scale takes too long, it does not. */
  keeps: boolean;
  /** ms of a frame at that scale, at the speed of this machine. */
  time: number;
}

/** Another tier must be nearer to the truth by this factor to be worth a new plan. */
const WORTH = 0.93;
const STEPS = 60;

const cost = ({ fixed, pixels }: TierCost, millions: number, scale: number) => fixed + pixels * millions * scale ** 2;

/** The error at a scale, between those that were measured; under the least, as it grew between the last two. */
export function errorAt(scales: readonly number[], errors: readonly number[], scale: number): number {
  const found = scales.findIndex((each) => each <= scale);
  if (found === 0 || scales.length < 2) return errors[0] ?? Infinity;
  const next = found < 0 ? scales.length - 1 : found;
  const [above, below, high, low] = [scales[next - 1], scales[next], errors[next - 1], errors[next]] as [number, number, number, number];
  return low + ((high - low) * (scale - below)) / (above - below);
}

/** Of every tier, the sharpest picture that keeps the law on this machine, which is as fast as the running tier shows. */
export function choices(front: readonly TierCost[], scales: readonly number[], running: string, now: Pacing): Choice[] {
  const known = front.find(({ tier }) => tier === running);
  if (known === undefined) return [];
  const speed = now.water / cost(known, now.pixels, now.scale);
  return front.map((each) => {
    const time = (scale: number) => now.rest + speed * cost(each, now.pixels, scale);
    const keeps = (scale: number) => time(scale) <= allowed(now.law, scale);
    let scale = LEAST;
    for (let step = 1; step <= STEPS; step++) {
      const tried = LEAST + ((1 - LEAST) * step) / STEPS;
      if (keeps(tried)) scale = tried;
    }
    return { tier: each.tier, scale, error: errorAt(scales, each.errors, scale), keeps: keeps(scale), time: time(scale) };
  });
}

/** Goes from tier to tier of one picture. A tier that was left is not come back to, so that this ends. */
export class AutoQuality {
  private readonly left = new Set<string>();

  /** The tier to run instead, and the scale to begin it with; null: what runs is as good. */
  next(fronts: Fronts, preset: string, running: string, now: Pacing): Choice | null {
    const all = choices(fronts.presets[preset] ?? [], fronts.scales, running, now);
    const current = all.find(({ tier }) => tier === running);
    if (current === undefined) return null;
    const open = all.filter(({ tier }) => !this.left.has(tier));
    // Where none keeps the law the fastest comes nearest to it, however little it is worth.
    const kept = open.filter(({ keeps }) => keeps);
    const [best] = kept.length > 0 ? kept.sort((a, b) => a.error - b.error) : open.sort((a, b) => a.time - b.time);
    if (best === undefined || best.tier === running) return null;
    if (current.keeps && best.error > WORTH * current.error) return null;
    this.left.add(running);
    return best;
  }

  /** Another picture: nothing was tried yet. */
  begin(): void {
    this.left.clear();
  }
}
