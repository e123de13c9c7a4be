import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import type { Api, TierCost, TierCosts } from "../../src/api";
import { AutoQuality, costRatio, errorAt, QualityPilot, tierChoices } from "../../src/app/autoquality";
import { allowedAt, costAt, MOTION_BUDGET, type RenderLoad } from "../../src/display/framebudget";
import type { Store } from "../../src/selection/selection";

const scales = [1, 0.5, 0.25];
const tierCosts: TierCost[] = [
  { tier: "fast", fixed: 2, pixels: 30, errors: [20, 26, 32] },
  { tier: "exact", fixed: 4, pixels: 120, errors: [12, 20, 31] },
];
const costsOf = (tiers: TierCost[]): TierCosts => ({ scales, presets: { sea: tiers } });
const costs = costsOf(tierCosts);

const DISPLAY = 1000 / 60;

/** The load of a machine slower by a factor than the one that measured the costs. */
function loadOf(tier: string, scale: number, slowdown: number, overhead = 5, tiers = tierCosts): RenderLoad {
  const { fixed, pixels } = tiers.find((cost) => cost.tier === tier) as (typeof tierCosts)[number];
  return { cost: { fixed: overhead + slowdown * fixed, pixels: slowdown * pixels }, scale, displayInterval: DISPLAY, budget: MOTION_BUDGET, megapixels: 1 };
}

describe("automatic quality", () => {
  it("interpolates errors between the scales and extrapolates below the least", () => {
    expect(errorAt(scales, [10, 20, 40], 0.75)).toBe(15);
    expect(errorAt(scales, [10, 20, 40], 0.5)).toBe(20);
    expect(errorAt(scales, [10, 20, 40], 0.1)).toBeCloseTo(52);
    expect(errorAt(scales, [10, 20, 40], 1)).toBe(10);
  });

  it("predicts the greatest scale within budget for every tier", () => {
    for (const { tier, scale } of tierChoices(tierCosts, scales, "fast", loadOf("fast", 0.4, 2))) {
      const { fixed, pixels } = tierCosts.find((cost) => cost.tier === tier) as (typeof tierCosts)[number];
      const cost = { fixed: 5 + 2 * fixed, pixels: 2 * pixels };
      expect(costAt(cost, scale)).toBeLessThanOrEqual(1.001 * allowedAt(scale, DISPLAY));
      expect(costAt(cost, scale + 0.05)).toBeGreaterThan(allowedAt(scale + 0.05, DISPLAY));
    }
  });

  it("selects the exact tier on a fast machine and the fast tier on a slow one", () => {
    expect(new AutoQuality().next(costs, "sea", "fast", loadOf("fast", 1, 0.02, 0))).toMatchObject({ tier: "exact", scale: 1 });
    expect(new AutoQuality().next(costs, "sea", "exact", loadOf("exact", 0.3, 30))?.tier).toBe("fast");
  });

  it("leaves a tier that exceeds the budget at every scale, and selects the fastest where all do", () => {
    const tiers = tierCosts.map((cost) => (cost.tier === "exact" ? { ...cost, fixed: 400, errors: [2, 3, 4] } : { ...cost, fixed: 10 }));
    const slow = costsOf(tiers);
    const now = (tier: string, slower: number) => loadOf(tier, 0.1, slower, 5, tiers);
    expect(new AutoQuality().next(slow, "sea", "exact", now("exact", 1))?.tier).toBe("fast");
    expect(new AutoQuality().next(slow, "sea", "fast", now("fast", 1))).toBeNull();
    // A machine so slow that no tier is within budget.
    expect(new AutoQuality().next(slow, "sea", "exact", now("exact", 100))?.tier).toBe("fast");
    expect(new AutoQuality().next(slow, "sea", "fast", now("fast", 100))).toBeNull();
  });

  it("keeps the tier where another gains little and where no costs are known", () => {
    const close = costsOf(tierCosts.map((cost) => ({ ...cost, errors: [10, 10, 10] })));
    expect(new AutoQuality().next(close, "sea", "fast", loadOf("fast", 1, 0.02))).toBeNull();
    expect(new AutoQuality().next(costs, "pond", "fast", loadOf("fast", 1, 0.02))).toBeNull();
    const little = costsOf(tierCosts.map((cost) => ({ ...cost, fixed: 2, pixels: 2, errors: cost.tier === "fast" ? [10, 11, 12] : [9, 11, 12] })));
    expect(new AutoQuality().next(little, "sea", "fast", loadOf("fast", 1, 1))).toBeNull();
    expect(new AutoQuality().next(little, "sea", "fast", { ...loadOf("fast", 1, 1), cost: null })?.tier).toBe("exact");
    expect(new AutoQuality().next(costs, "sea", '{"samples":4}', loadOf("fast", 1, 0.02))).toBeNull();
  });

  it("selects the tier that errs no more where it is much faster", () => {
    const quick = costsOf(tierCosts.map((cost) => ({ ...cost, errors: cost.tier === "fast" ? [9, 11, 13] : [9, 12, 14] })));
    const { tier, scale } = new AutoQuality().next(quick, "sea", "exact", loadOf("exact", 0.46, 2, 0)) ?? { tier: null, scale: 0 };
    expect(tier).toBe("fast");
    expect(scale).toBeGreaterThan(0.46);
  });

  it("selects motion that is fluent rather than a smaller error", () => {
    const sea = { scales: [1, 0.5], presets: { sea: [{ tier: "fast", fixed: 5, pixels: 200, errors: [7, 12] }, { tier: "exact", fixed: 15, pixels: 490, errors: [5, 10] }] } };
    const load: RenderLoad = { cost: null, scale: 0.5, displayInterval: DISPLAY, budget: [[0.5, 240], [0.52, 62], [1, 54]], megapixels: 1 };
    const [fast, exact] = tierChoices(sea.presets.sea, sea.scales, "fast", load);
    expect(exact?.error).toBeLessThan(fast?.error ?? 0);
    expect(exact?.withinBudget).toBe(true);
    for (const tier of ["fast", "exact"]) expect(new AutoQuality().next(sea, "sea", tier, load)?.tier ?? tier).toBe("fast");
    // Measured, too.
    expect(new AutoQuality().next(sea, "sea", "exact", { ...load, cost: { fixed: 15, pixels: 490 } })?.tier).toBe("fast");
  });

  it("weighs error and time where no tier is fluent", () => {
    const chosen = (errors: number) => {
      const sea = costsOf([{ tier: "fast", fixed: 80, pixels: 200, errors: [20, 20, 20] }, { tier: "exact", fixed: 120, pixels: 400, errors: [errors, errors, errors] }]);
      return new AutoQuality().next(sea, "sea", "fast", { cost: null, scale: 0.5, displayInterval: DISPLAY, budget: [[0.5, 240], [0.52, 62], [1, 54]], megapixels: 1 })?.tier ?? "fast";
    };
    // At half the size they take 130 and 220 ms.
    expect(chosen(16)).toBe("fast");
    expect(chosen(8)).toBe("exact");
  });

  it("knows how much more one preset costs than another", () => {
    const presets = { sea: tierCosts, pond: [{ tier: "fast", fixed: 1, pixels: 15, errors: [1, 1, 1] }] };
    expect(costRatio({ scales, presets }, ["pond", "fast"], ["sea", "exact"])).toBeCloseTo(124 / 16);
    expect(costRatio({ scales, presets }, ["pond", "exact"], ["sea", "exact"])).toBe(1);
  });

  it("does not return to a tier that it left", () => {
    const auto = new AutoQuality();
    expect(auto.next(costs, "sea", "fast", loadOf("fast", 1, 0.02))?.tier).toBe("exact");
    expect(auto.next(costs, "sea", "exact", loadOf("exact", 0.3, 30))).toBeNull();
    auto.reset();
    expect(auto.next(costs, "sea", "exact", loadOf("exact", 0.3, 30))?.tier).toBe("fast");
  });
});

describe("the tier of the server's frames in motion", () => {
  const slow = { ...loadOf("exact", 0.5, 30), cost: null };

  async function piloted(selected: object) {
    const now = { preset: { name: "sea" }, quality: "exact", auto: true, split: null, ...selected };
    const pilot = new QualityPilot({ tierCosts: () => Promise.resolve(costsOf(slowTiers)) } as unknown as Api, { now } as unknown as Store);
    await Promise.resolve();
    return pilot;
  }
  const slowTiers = tierCosts.map((one) => ({ ...one, fixed: 40 * one.fixed, pixels: 40 * one.pixels }));

  it("is chosen before a frame is measured, and leaves the selection as it is", async () => {
    const pilot = await piloted({});
    expect(pilot.movingTier(slow)).toEqual({ tier: "fast", cost: (80 + 1200) / (160 + 4800) });
    expect(pilot.movingTier(slow)).toEqual({ tier: "fast", cost: 1 });
  });

  it("is the selection's where the user chose it, or compares two", async () => {
    expect((await piloted({ auto: false })).movingTier(slow)).toBeNull();
    expect((await piloted({ split: {} })).movingTier(slow)).toBeNull();
  });
});

describe("fronts.json", () => {
  const costs = JSON.parse(readFileSync(new URL("../../public/fronts.json", import.meta.url), "utf8")) as TierCosts;

  it("has valid costs for every preset", () => {
    expect([...costs.scales].sort((a, b) => b - a)).toEqual(costs.scales);
    for (const [name, tiers] of Object.entries(costs.presets)) {
      expect(tiers.length, name).toBeGreaterThan(1);
      for (const { fixed, pixels, errors } of tiers) {
        expect(fixed, name).toBeGreaterThanOrEqual(0);
        expect(pixels, name).toBeGreaterThan(0);
        expect(errors.length, name).toBe(costs.scales.length);
        expect(Math.min(...errors), name).toBeGreaterThan(0);
      }
    }
  });
});
