import { describe, expect, it } from "vitest";
import { budgetAt, bestScale, CPU_BUDGET, gpuBudget, DynamicResolution, type FrameBudget } from "../src/app/resolution";

/** A machine: ms of a frame: constant, per full-size picture, and outside rendering. */
interface Machine {
  fixed: number;
  pixels: number;
  overhead: number;
}

/** Render time and interval of a frame at a scale, ms. */
function times({ fixed, pixels, overhead }: Machine, scale: number): [number, number] {
  const renderTime = fixed + pixels * scale ** 2;
  return [renderTime, renderTime + overhead];
}

function run(resolution: DynamicResolution, machine: Machine, frames: number, budget: FrameBudget = CPU_BUDGET): number[] {
  const scales = [];
  for (let i = 0; i < frames; i++) {
    resolution.addFrame(budget, ...times(machine, resolution.scale));
    scales.push(resolution.scale);
  }
  return scales;
}

const FAST = { fixed: 1, pixels: 8, overhead: 4 };
const MEDIUM = { fixed: 2, pixels: 70, overhead: 8 };
const SLOW = { fixed: 5, pixels: 300, overhead: 10 };

describe("the frame budget", () => {
  it("is linear between its points and constant beyond", () => {
    const budget: FrameBudget = [
      [0.2, 100],
      [0.6, 20],
    ];
    expect([0.1, 0.2, 0.4, 0.6, 1].map((scale) => budgetAt(budget, scale))).toEqual([100, 100, 60, 20, 20]);
  });

  it("does not grow with the scale", () => {
    for (const budget of [CPU_BUDGET, gpuBudget(1000 / 60)]) {
      const milliseconds = Array.from({ length: 100 }, (_, i) => budgetAt(budget, (i + 1) / 100));
      expect([...milliseconds].sort((a, b) => b - a)).toEqual(milliseconds);
    }
  });
});

describe("the best scale", () => {
  it("uses the whole budget", () => {
    for (const now of [0.1, 0.35, 1]) {
      const [renderTime, interval] = times({ fixed: 0, pixels: 80, overhead: 8 }, now);
      const best = bestScale(CPU_BUDGET, now, renderTime, interval);
      expect(8 + 80 * best ** 2).toBeCloseTo(budgetAt(CPU_BUDGET, best), 1);
    }
  });

  it("is 1 where the budget allows it", () => {
    expect(bestScale(CPU_BUDGET, 0.3, 2, 8)).toBe(1);
  });

  it("keeps a share of the time for rendering where overhead dominates", () => {
    // 10 ms of 90 are rendering: the other 80 remain at any scale.
    const best = bestScale(CPU_BUDGET, 0.5, 10, 90);
    expect(best).toBeGreaterThanOrEqual(0.5);
    expect(10 * (best / 0.5) ** 2).toBeGreaterThanOrEqual(0.5 * 80 - 1e-9);
  });
});

describe("dynamic resolution", () => {
  it("settles on a scale", () => {
    for (const machine of [MEDIUM, SLOW]) {
      const scales = run(new DynamicResolution(0.5), machine, 400);
      expect(new Set(scales.slice(-200)).size).toBe(1);
      const scale = scales.at(-1) as number;
      const [, interval] = times(machine, scale);
      expect(interval).toBeLessThan(1.15 * budgetAt(CPU_BUDGET, scale));
      expect(scale).toBeLessThan(1);
    }
    expect(run(new DynamicResolution(0.5), FAST, 200).at(-1)).toBe(1);
  });

  it("settles on the same scale from above and from below", () => {
    const from = (start: number) => run(new DynamicResolution(start), MEDIUM, 400).at(-1) as number;
    expect(from(0.1) / from(1)).toBeGreaterThan(0.9);
    expect(from(0.1) / from(1)).toBeLessThan(1.1);
  });

  it("recovers after a slow phase", () => {
    const resolution = new DynamicResolution(0.5);
    const before = run(resolution, MEDIUM, 200).at(-1) as number;
    const [fixed, pixels] = [4 * MEDIUM.fixed, 4 * MEDIUM.pixels];
    const during = run(resolution, { fixed, pixels, overhead: 60 }, 200).at(-1) as number;
    expect(during).toBeLessThan(0.9 * before);
    const after = run(resolution, MEDIUM, 200).at(-1) as number;
    expect(after / before).toBeGreaterThan(0.9);
  });

  it("ignores single slow frames", () => {
    const resolution = new DynamicResolution(1);
    resolution.addFrame(CPU_BUDGET, 900, 900);
    resolution.addFrame(CPU_BUDGET, 500, 500);
    expect(run(resolution, FAST, 50).every((scale) => scale === 1)).toBe(true);
  });

  it("keeps the display's rate on a GPU", () => {
    const [display, alone] = [1000 / 120, { fixed: 0.5, pixels: 12, overhead: 0 }];
    const scale = run(new DynamicResolution(1), alone, 400, gpuBudget(display)).at(-1) as number;
    expect(times(alone, scale)[0]).toBeLessThan(display);
    expect(scale).toBeGreaterThan(0.7);
  });
});
