import { describe, expect, it } from "vitest";
import { allowed, bestScale, ON_CPU, onGpu, Pace, type Law } from "../src/app/pace";

/** A machine: ms of a frame's water at full size and of what it does besides. */
interface Machine {
  fixed: number;
  pixels: number;
  rest: number;
}

/** The water's time and the interval of a frame at a scale. */
function times({ fixed, pixels, rest }: Machine, scale: number): [number, number] {
  const water = fixed + pixels * scale ** 2;
  return [water, water + rest];
}

function run(pace: Pace, machine: Machine, frames: number, law: Law = ON_CPU): number[] {
  const scales = [];
  for (let i = 0; i < frames; i++) {
    pace.frame(law, ...times(machine, pace.scale));
    scales.push(pace.scale);
  }
  return scales;
}

const FAST = { fixed: 1, pixels: 8, rest: 4 };
const MIDDLING = { fixed: 2, pixels: 70, rest: 8 };
const SLOW = { fixed: 5, pixels: 300, rest: 10 };

describe("the law", () => {
  it("is linear between its points and constant beyond", () => {
    const law: Law = [
      [0.2, 100],
      [0.6, 20],
    ];
    expect([0.1, 0.2, 0.4, 0.6, 1].map((scale) => allowed(law, scale))).toEqual([100, 100, 60, 20, 20]);
  });

  it("asks for more frames of a sharper picture, never for fewer", () => {
    for (const law of [ON_CPU, onGpu(1000 / 60)]) {
      const milliseconds = Array.from({ length: 100 }, (_, i) => allowed(law, (i + 1) / 100));
      expect([...milliseconds].sort((a, b) => b - a)).toEqual(milliseconds);
    }
  });
});

describe("the best scale", () => {
  it("keeps the law as nearly as can be", () => {
    for (const now of [0.1, 0.35, 1]) {
      const [water, interval] = times({ fixed: 0, pixels: 80, rest: 8 }, now);
      const best = bestScale(ON_CPU, now, water, interval);
      expect(8 + 80 * best ** 2).toBeCloseTo(allowed(ON_CPU, best), 1);
    }
  });

  it("is whole where there is room", () => {
    expect(bestScale(ON_CPU, 0.3, 2, 8)).toBe(1);
  });

  it("leaves the water its share where something else takes the time", () => {
    // 10 ms of water in 90: without water it would be 80 still.
    const best = bestScale(ON_CPU, 0.5, 10, 90);
    expect(best).toBeGreaterThanOrEqual(0.5);
    expect(10 * (best / 0.5) ** 2).toBeGreaterThanOrEqual(0.5 * 80 - 1e-9);
  });
});

describe("the pace", () => {
  it("finds its scale and stays there", () => {
    for (const machine of [MIDDLING, SLOW]) {
      const scales = run(new Pace(0.5), machine, 400);
      expect(new Set(scales.slice(-200)).size).toBe(1);
      const scale = scales.at(-1) as number;
      const [, interval] = times(machine, scale);
      expect(interval).toBeLessThan(1.15 * allowed(ON_CPU, scale));
      expect(scale).toBeLessThan(1);
    }
    expect(run(new Pace(0.5), FAST, 200).at(-1)).toBe(1);
  });

  it("comes to the same scale from above and from below", () => {
    const from = (start: number) => run(new Pace(start), MIDDLING, 400).at(-1) as number;
    expect(from(0.1) / from(1)).toBeGreaterThan(0.9);
    expect(from(0.1) / from(1)).toBeLessThan(1.1);
  });

  it("recovers when what slowed it is over", () => {
    const pace = new Pace(0.5);
    const before = run(pace, MIDDLING, 200).at(-1) as number;
    const [fixed, pixels] = [4 * MIDDLING.fixed, 4 * MIDDLING.pixels];
    const during = run(pace, { fixed, pixels, rest: 60 }, 200).at(-1) as number;
    expect(during).toBeLessThan(0.9 * before);
    const after = run(pace, MIDDLING, 200).at(-1) as number;
    expect(after / before).toBeGreaterThan(0.9);
  });

  it("is not led astray by single slow frames", () => {
    const pace = new Pace(1);
    pace.frame(ON_CPU, 900, 900);
    pace.frame(ON_CPU, 500, 500);
    expect(run(pace, FAST, 50).every((scale) => scale === 1)).toBe(true);
  });

  it("keeps a display's rate on a GPU", () => {
    const [display, alone] = [1000 / 120, { fixed: 0.5, pixels: 12, rest: 0 }];
    const scale = run(new Pace(1), alone, 400, onGpu(display)).at(-1) as number;
    expect(times(alone, scale)[0]).toBeLessThan(display);
    expect(scale).toBeGreaterThan(0.7);
  });
});
