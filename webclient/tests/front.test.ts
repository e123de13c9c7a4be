import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { AutoQuality, choices, errorAt, type Fronts, type Pacing, type TierCost } from "../src/app/front";
import { allowed, ON_CPU, onGpu } from "../src/app/pace";

const scales = [1, 0.5, 0.25];
const front: TierCost[] = [
  { tier: "fast", fixed: 2, pixels: 30, errors: [20, 26, 32] },
  { tier: "exact", fixed: 4, pixels: 120, errors: [12, 20, 31] },
];
const sea = (tiers: TierCost[]): Fronts => ({ scales, presets: { sea: tiers } });
const fronts = sea(front);

/** A machine so many times as slow as the one that was measured, at this tier and scale. */
function pacing(tier: string, scale: number, slower: number, law = ON_CPU, rest = 5, tiers = front): Pacing {
  const { fixed, pixels } = tiers.find((each) => each.tier === tier) as (typeof front)[number];
  return { law, scale, rest, pixels: 1, water: slower * (fixed + pixels * scale ** 2) };
}

describe("the front", () => {
  it("knows errors between the scales that were measured, and as they grow under the least", () => {
    expect(errorAt(scales, [10, 20, 40], 0.75)).toBe(15);
    expect(errorAt(scales, [10, 20, 40], 0.5)).toBe(20);
    expect(errorAt(scales, [10, 20, 40], 0.1)).toBeCloseTo(52);
    expect(errorAt(scales, [10, 20, 40], 1)).toBe(10);
  });

  it("predicts a scale for every tier that keeps the law", () => {
    for (const { tier, scale } of choices(front, scales, "fast", pacing("fast", 0.4, 2))) {
      const { fixed, pixels } = front.find((each) => each.tier === tier) as (typeof front)[number];
      expect(5 + 2 * (fixed + pixels * scale ** 2)).toBeLessThanOrEqual(allowed(ON_CPU, scale));
      expect(5 + 2 * (fixed + pixels * (scale + 0.05) ** 2)).toBeGreaterThan(allowed(ON_CPU, scale + 0.05));
    }
  });

  it("takes samples where there is time and sharpness where there is not", () => {
    const gpu = onGpu(1000 / 60);
    expect(new AutoQuality().next(fronts, "sea", "fast", pacing("fast", 1, 0.02, gpu, 0))).toMatchObject({ tier: "exact", scale: 1 });
    expect(new AutoQuality().next(fronts, "sea", "exact", pacing("exact", 0.3, 6))?.tier).toBe("fast");
  });

  it("leaves a tier that is too slow at every scale, however exact it is, and else takes the fastest", () => {
    const tiers = front.map((each) => (each.tier === "exact" ? { ...each, fixed: 400, errors: [2, 3, 4] } : { ...each, fixed: 10 }));
    const slow = sea(tiers);
    const now = (tier: string, slower: number) => pacing(tier, 0.1, slower, ON_CPU, 5, tiers);
    expect(new AutoQuality().next(slow, "sea", "exact", now("exact", 1))?.tier).toBe("fast");
    expect(new AutoQuality().next(slow, "sea", "fast", now("fast", 1))).toBeNull();
    // A machine so slow that nothing keeps the law.
    expect(new AutoQuality().next(slow, "sea", "exact", now("exact", 100))?.tier).toBe("fast");
    expect(new AutoQuality().next(slow, "sea", "fast", now("fast", 100))).toBeNull();
  });

  it("stays where another tier gains little, and where nothing was measured", () => {
    const close = sea(front.map((each) => ({ ...each, errors: [10, 10, 10] })));
    expect(new AutoQuality().next(close, "sea", "fast", pacing("fast", 1, 0.02))).toBeNull();
    expect(new AutoQuality().next(fronts, "pond", "fast", pacing("fast", 1, 0.02))).toBeNull();
    expect(new AutoQuality().next(fronts, "sea", '{"samples":4}', pacing("fast", 1, 0.02))).toBeNull();
  });

  it("does not go back and forth within a picture", () => {
    const auto = new AutoQuality();
    expect(auto.next(fronts, "sea", "fast", pacing("fast", 1, 0.02))?.tier).toBe("exact");
    expect(auto.next(fronts, "sea", "exact", pacing("exact", 0.3, 6))).toBeNull();
    auto.begin();
    expect(auto.next(fronts, "sea", "exact", pacing("exact", 0.3, 6))?.tier).toBe("fast");
  });
});

describe("what was measured", () => {
  const made = JSON.parse(readFileSync(new URL("../public/fronts.json", import.meta.url), "utf8")) as Fronts;

  it("is of use for every preset in it", () => {
    expect([...made.scales].sort((a, b) => b - a)).toEqual(made.scales);
    for (const [name, tiers] of Object.entries(made.presets)) {
      expect(tiers.length, name).toBeGreaterThan(1);
      for (const { fixed, pixels, errors } of tiers) {
        expect(fixed, name).toBeGreaterThanOrEqual(0);
        expect(pixels, name).toBeGreaterThan(0);
        expect(errors.length, name).toBe(made.scales.length);
        expect(Math.min(...errors), name).toBeGreaterThan(0);
      }
    }
  });
});
