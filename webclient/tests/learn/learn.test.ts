import { describe, expect, it } from "vitest";
import { coverage, overSample, thresholdOf } from "../../src/learn/maths/filtered";
import { amount, CONSTANTS, frontSaturation, heightSaturation, type Look, period, phase, PopCounter, VISIBLE } from "../../src/learn/maths/wave";
import { type Mask, shuffledRanks, thresholds } from "../../src/learn/maths/mask";
import { spectrum, unevenness } from "../../src/learn/maths/spectrum";
import { golden as read } from "../golden";

interface Golden {
  fronts: { constants: string; delta: number; base: number; intensity: number; theta: number[]; saturation: number[] }[];
  heights: { height: number[]; base: number; full: number; saturation: number[] };
  amounts: { look: Exclude<Look, "filtered">; f: number[]; m: number[]; t: number[]; amount: number[] }[];
  mask: { size: number; words: number[]; quantiles: number[] };
  sample: number;
  filtered: { s: number; fade: number; x: number[]; y: number[]; coverage: number[] }[];
  spectra: { grey: number; raps: number[] }[];
  white: { seed: number; ranks: number[] };
}

const golden = read("foam_strips") as Golden;
const { size, words, quantiles } = golden.mask;
const mask: Mask = { name: "golden", title: "", size, values: thresholds(Uint16Array.from(words)), quantiles };

describe("formulas of the chapter agree with the float64 reference", () => {
  it.each(golden.fronts.map((one) => [`${one.constants}, C ${one.intensity}`, one] as const))("front: %s", (_, one) => {
    one.theta.forEach((theta, i) => expect(frontSaturation(theta, one)).toBeCloseTo(one.saturation[i] ?? NaN, 10));
  });

  it("has the paper's constants", () => {
    for (const name of ["text", "listing"] as const) {
      const one = golden.fronts.find(({ constants }) => constants === name);
      expect(CONSTANTS[name].base).toBe(one?.base);
      expect(CONSTANTS[name].delta).toBe(one?.delta);
    }
  });

  it("height", () => {
    const { height, base, full, saturation } = golden.heights;
    height.forEach((H, i) => expect(heightSaturation(H, base, full)).toBeCloseTo(saturation[i] ?? NaN, 12));
  });

  it.each(golden.amounts.map((one) => [one.look, one] as const))("look: %s", (look, { f, m, t, amount: expected }) => {
    expected.forEach((a, i) => expect(amount(look, f[i] ?? NaN, m[i] ?? NaN, t[i] ?? NaN)).toBeCloseTo(a, 12));
  });

  it.each(golden.filtered.map((one) => [one.s, one.fade, one] as const))("filtered at %f, fade %f", (s, fade, { x, y, coverage: expected }) => {
    const threshold = thresholdOf(mask.quantiles, s, fade);
    expected.forEach((a, i) => expect(coverage(threshold, ...overSample(mask, x[i] ?? NaN, y[i] ?? NaN, golden.sample))).toBeCloseTo(a, 6));
    const mean = expected.reduce((sum, a) => sum + a, 0) / expected.length;
    expect(mean > 0).toBe(s > 0.01);
  });

  it.each(golden.spectra.map((one) => [one.grey, one] as const))("spectrum at grey %f", (grey, { raps }) => {
    const found = spectrum(mask, grey).map(([, power]) => power);
    expect(found.length).toBe(raps.length);
    raps.forEach((power, i) => expect(found[i]).toBeCloseTo(power, 9));
  });

  it("white noise", () => {
    expect([...shuffledRanks(golden.white.ranks.length, golden.white.seed)]).toEqual(golden.white.ranks);
  });
});

describe("bubbles", () => {
  const wavelength = 12;

  /** Pops of every texel while a wave passes, in `steps` frames. */
  function pops(look: Exclude<Look, "filtered">, steps: number): number {
    const counter = new PopCounter(mask.values.length);
    const front = { ...CONSTANTS.text, intensity: 4 };
    // From the trough between two fronts to the next.
    for (let step = 0; step <= steps; step++) {
      const f = frontSaturation(phase(0, (step / steps) * period(wavelength), wavelength) - 1e-6, front);
      mask.values.forEach((m, i) => counter.see(i, amount(look, f, m, 1)));
    }
    return counter.pops;
  }

  it.each(["halftone", "fading", "halftone_textured", "listing"] as const)("each pops once in a period: %s", (look) => {
    expect(pops(look, 400)).toBe(mask.values.length);
  });

  it("have faded when they pop, except where the equation cuts them off", () => {
    const before = (look: Exclude<Look, "filtered">) => amount(look, 0.4 + 1e-6, 0.4, 1);
    expect(before("halftone")).toBe(1);
    expect(before("fading")).toBeLessThan(VISIBLE);
    expect(before("halftone_textured")).toBeLessThan(VISIBLE);
    expect(before("listing")).toBe(0.15);
  });

  it("lie more evenly under blue noise than under white noise", () => {
    const ranks = shuffledRanks(mask.values.length, 1);
    const white = { ...mask, values: Float32Array.from(ranks, (rank) => (rank + 0.5) / ranks.length) };
    expect(unevenness(mask, 0.25, 8)).toBeLessThan(0.5 * unevenness(white, 0.25, 8));
  });
});
