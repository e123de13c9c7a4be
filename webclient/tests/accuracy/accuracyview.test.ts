import { describe, expect, it } from "vitest";
import type { Point } from "../../src/accuracy/api";
import { curvesOf, placeLabels } from "../../src/accuracy/diagram/curves";
import { type BenchmarkResult, type ExportedRun, type Measured, measuredThere, ranked, rowsOf, toCsv, toJson } from "../../src/accuracy/measure/measured";
import { budgetAt, budgetRange, choose, SLIDER_STEPS, stepOf } from "../../src/accuracy/measure/budget";
import { luminance, radialSpectrum } from "../../src/accuracy/measure/errors";
import { equalError, equalTime, regionAround, worstPixel } from "../../src/accuracy/pictures/pictures";

const [WIDTH, HEIGHT] = [48, 30];

/** Values of each pixel. */
function plane(value: (x: number, y: number) => number): Float64Array {
  return Float64Array.from({ length: WIDTH * HEIGHT }, (_, i) => value(i % WIDTH, Math.floor(i / WIDTH)));
}

describe("the spectrum of an error", () => {
  it("has a wave's power at its frequency", () => {
    // Ten waves across: 10/48 cycles per pixel, ring 6.25 of a side of 30.
    const { frequency, power } = radialSpectrum(plane((x) => 4 * Math.cos((2 * Math.PI * 10 * x) / WIDTH)), WIDTH, HEIGHT, false);
    const top = power.indexOf(Math.max(...power));
    expect(frequency[top]).toBeCloseTo(6 / 30, 6);
    expect(frequency.at(-1)).toBe(0.5);
    const rest = power.filter((_, ring) => ring !== top);
    expect(Math.max(...rest)).toBeLessThan(1e-9 * (power[top] ?? 0));
  });

  it("is flat for noise, and with a window keeps its power", () => {
    let state = 12345;
    const noise = plane(() => {
      state = (state * 1103515245 + 12345) % 2147483648;
      return state / 2147483648 - 0.5;
    });
    const square = noise.reduce((sum, value) => sum + value * value, 0) / noise.length;
    for (const windowed of [false, true]) {
      const { power } = radialSpectrum(noise, WIDTH, HEIGHT, windowed);
      const mean = power.slice(3).reduce((sum, value) => sum + value, 0) / (power.length - 3);
      // The mean square, shared by all bins.
      expect((mean * WIDTH * HEIGHT) / square).toBeGreaterThan(0.85);
      expect((mean * WIDTH * HEIGHT) / square).toBeLessThan(1.15);
    }
  });

  it("does not see the mean", () => {
    expect(Math.max(...radialSpectrum(plane(() => 7), WIDTH, HEIGHT).power)).toBeLessThan(1e-20);
  });

  it("is of luminance in levels, clipped at white", () => {
    const picture = (...pixels: number[]) => ({ width: 1, height: 1, pixels: Float32Array.from(pixels) });
    expect(luminance(picture(0, 3, 0, 0))[0]).toBeCloseTo(255 * 0.7152, 3);
    expect(luminance(picture(1, 1, 1, 0), picture(9, 9, 9, 0))[0]).toBe(0);
  });
});

function point(id: string, pointer: string | null, value: string | number | boolean = 0): Point {
  const parameter = pointer === null ? null : { owner: "o", pointer, title: pointer.slice(1), cause: "filtering", value };
  return { id, label: id, tier: pointer === null ? id : null, parameter, quality: { steps: 32, mode: "grid", on: false } };
}

describe("curves", () => {
  const standard = point("standard", null);
  const times: Record<string, number> = { standard: 5, many: 9, fine: 8, plain: 3, yes: 7 };
  const points = [point("a", "/steps", 8), point("b", "/steps", 16), point("c", "/steps", 64), standard];
  const time = (id: string) => times[id] ?? 1;

  it.each([
    [points, ["a", "b", "standard", "c"]],
    [points.slice(0, 2), ["a", "b", "standard"]],
    [[...points].reverse(), ["c", "standard", "b", "a"]],
    [[point("fine", "/mode", "fine"), point("plain", "/mode", "plain")], ["standard", "fine", "plain"]],
    [[point("yes", "/on", true)], ["standard", "yes"]],
  ])("go through the standard value %#", (list, ids) => {
    const [curve] = curvesOf(list, standard, time);
    expect(curve?.points.map(({ id }) => id)).toEqual(ids);
  });

  it("name values", () => {
    expect(curvesOf([point("fine", "/mode", "fine")], standard, time)[0]?.points.map(({ value }) => value)).toEqual(["grid", "fine"]);
  });
});

const timed = (id: string, time: number, high: number, error: number) => ({ id, time, high, error });

describe("insets", () => {
  const all = [timed("fast", 1, 1.2, 8), timed("good", 4, 4.4, 2), timed("same", 4.2, 4.6, 3), timed("slow", 9, 9.5, 2.01), timed("best", 20, 21, 1)];
  const of = (id: string) => all.find((one) => one.id === id) ?? timed("", 0, 0, 0);

  it.each([["fast", null, "good"], ["good", "same", "slow"], ["same", "good", "good"], ["slow", "good", "good"], ["best", "good", null]])(
    "of %s: equal time %s, equal error %s",
    (id, time, error) => {
      expect(equalTime(of(id), all)?.id ?? null).toBe(time);
      expect(equalError(of(id), all)?.id ?? null).toBe(error);
    },
  );

  it("show a quarter around the loupe, within the picture", () => {
    expect(regionAround({ x: 80, y: 45 }, 160, 90)).toEqual({ x: 60, y: 34, width: 40, height: 23 });
    expect(regionAround({ x: 0, y: 89 }, 160, 90)).toEqual({ x: 0, y: 67, width: 40, height: 23 });
  });

  it("start at the worst pixel", () => expect(worstPixel(Float32Array.from([0, 1, 5, 2, 0, 5]), 3)).toEqual({ x: 2, y: 0 }));
});

function measured(id: string, time: number, rmse: number, flip: number): Measured {
  const errors = { rmse, flip, max: 10 * rmse, coverage: 0.1 };
  return { id, point: point(id, id === "fast" ? null : "/steps", 8), time, error: rmse, low: 0.9 * time, high: 1.1 * time, rounds: [time], errors };
}

describe("what a diagram shows", () => {
  const list = [measured("slow", 8, 1, 0.2), measured("fast", 1, 4, 0.1), measured("bad", 9, 2, 0.05)];

  it("is on the front of the chosen measure", () => {
    const front = (metric: "rmse" | "flip") => ranked(list, metric).flatMap(({ id, onFront }) => (onFront ? id : []));
    expect(front("rmse")).toEqual(["slow", "fast"]);
    expect(front("flip")).toEqual(["fast", "bad"]);
    expect(ranked(list, "max").map(({ error }) => error)).toEqual([10, 40, 20]);
  });

  it("has the server's times at this machine's size, quartiles alike", () => {
    const error = { rmse: 1, flip: 0.1, max: 2, coverage: 0.1 };
    const served = { ...point("fast", null), model: { fixed_ms: 1, ns_per_pixel: 1000 }, time: { median_ms: 10, low_ms: 9, high_ms: 12 }, error };
    const sizes: BenchmarkResult["sizes"] = { large: [100, 20], small: [10, 2] };
    const [one] = measuredThere({ machine: { renderer: "r" }, points: [served] }, { measured: [], unsupported: [], sizes, byGpu: false, rounds: 1 });
    expect([one?.time, one?.low, one?.high].map((time) => Number(time?.toFixed(6)))).toEqual([3, 2.7, 3.6]);
  });

  const shown: ExportedRun = { preset: "default", width: 320, height: 180, method: "m", rows: rowsOf(list, 'GL "two", one') };

  it("is CSV", () => {
    const [head, first, second, , last] = toCsv(shown).split("\n");
    expect(head?.split(",")).toHaveLength(15);
    expect(first).toBe('"GL ""two"", one",slow,slow,,/steps,8,1,8,7.2,8.8,8,1,0.2,10,0.1');
    expect(second).toContain(",fast,fast,fast,,,1,1,");
    expect(last).toBe("");
  });

  it("is JSON", () => {
    const parsed = JSON.parse(toJson(shown)) as { preset: string; timing: unknown; points: { id: string; on_front: boolean; error: unknown }[] };
    expect([parsed.preset, parsed.timing]).toEqual(["default", { width: 320, height: 180 }]);
    expect(parsed.points.map(({ id, on_front: front }) => [id, front])).toEqual([["slow", true], ["fast", true], ["bad", false]]);
    expect(parsed.points[0]?.error).toEqual({ rmse: 1, flip: 0.2, max: 10, coverage: 0.1 });
  });

  it("has labels that do not cover each other", () => {
    const spots = [["a", 100, 100], ["b", 104, 102], ["c", 96, 98]].map(([id, x, y]) => ({ id: String(id), x: Number(x), y: Number(y), text: "label" }));
    const labels = placeLabels(spots, spots, 300, 300);
    expect(new Set(labels.map(({ x, y, anchor }) => `${x} ${y} ${anchor}`)).size).toBe(3);
  });
});

describe("the budget's slider", () => {
  const predicted = [["fast", 1, 8], ["good", 4, 2], ["odd", 4.5, 3], ["slow", 16, 1]].map(([id, time, error]) => ({ id: String(id), label: "", time: Number(time), error: Number(error) }));
  const range = budgetRange(predicted);

  it("is logarithmic, over all qualities", () => {
    expect(range).toEqual([0.8, 20]);
    expect([budgetAt(0, range), budgetAt(SLIDER_STEPS, range)]).toEqual([0.8, 20]);
    expect(budgetAt(SLIDER_STEPS / 2, range)).toBe(4);
    for (const step of [0, 50, 133, SLIDER_STEPS]) expect(stepOf(budgetAt(step, range), range)).toBe(step);
    expect(stepOf(1e6, range)).toBe(SLIDER_STEPS);
  });

  it.each([[0.5, "fast", 0], [1, "fast", 1], [5, "good", 3], [100, "slow", 4]])("at %d ms picks %s", (budget, id, fitting) => {
    const choice = choose(predicted, budget, 640, 360);
    expect([choice?.id, choice?.fitting.size]).toEqual([id, fitting]);
    expect(choice?.reason).toContain(`640 × 360`);
  });

  it("picks nothing of nothing", () => expect(choose([], 5, 640, 360)).toBeNull());
});
