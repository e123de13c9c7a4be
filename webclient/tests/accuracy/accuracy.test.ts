import { describe, expect, it } from "vitest";
import type { Point } from "../../src/accuracy/api";
import { compare, fitModel, formatFactor, formatNumber, measuredHere, median, paretoFront, quantile } from "../../src/accuracy/measure/measured";
import { qualityRequest } from "../../src/accuracy/measure/benchmark";
import { benefits } from "../../src/accuracy/measure/budget";
import { errorMap, ErrorMeter, percentile, type Picture, pixelErrors, readPicture } from "../../src/accuracy/measure/errors";
import { heatColour } from "../../src/accuracy/pictures/pictures";
import { logAxis, tickLabel, tickLabels } from "../../src/charts/axis";
import { parseQuality, qualityTitle } from "../../src/selection/selection";

/** A .npy file as NumPy writes it. */
function npy(descr: string, shape: string, data: ArrayLike<number>, version = 1, fortran = "False"): ArrayBuffer {
  const start = version === 1 ? 10 : 12;
  const dictionary = `{'descr': '${descr}', 'fortran_order': ${fortran}, 'shape': ${shape}, }`;
  const length = Math.ceil((start + dictionary.length + 1) / 64) * 64 - start;
  const text = `${dictionary.padEnd(length - 1)}\n`;
  const bytes = new Uint8Array(start + length + 4 * data.length);
  bytes.set([0x93, ...new TextEncoder().encode("NUMPY"), version, 0]);
  const view = new DataView(bytes.buffer);
  if (version === 1) view.setUint16(8, length, true);
  else view.setUint32(8, length, true);
  bytes.set(new TextEncoder().encode(text), start);
  Array.from(data).forEach((value, i) => view.setFloat32(start + length + 4 * i, value, true));
  return bytes.buffer;
}

const values = Array.from({ length: 24 }, (_, i) => i / 8);

describe("a .npy file", () => {
  it.each([1, 2])("is read in format version %i", (version) => {
    const picture = readPicture(npy("<f4", "(2, 3, 4)", values, version));
    expect([picture.width, picture.height]).toEqual([3, 2]);
    expect([...picture.pixels]).toEqual(values);
  });

  it("is read wherever its header ends", () => {
    const whole = new Uint8Array(npy("<f4", "(2, 3, 4)", values));
    // One space less: the numbers no longer begin at a multiple of four.
    const at = whole.lastIndexOf(0x20, 8 + (whole[8] ?? 0));
    const odd = new Uint8Array([...whole.subarray(0, at), ...whole.subarray(at + 1)]);
    odd[8] = (odd[8] ?? 0) - 1;
    expect([...readPicture(odd.buffer).pixels]).toEqual(values);
  });

  it.each([
    ["another type", npy("<f8", "(2, 3, 4)", values)],
    ["another order of bytes", npy(">f4", "(2, 3, 4)", values)],
    ["columns first", npy("<f4", "(2, 3, 4)", values, 1, "True")],
    ["three channels", npy("<f4", "(2, 4, 3)", values)],
    ["no picture", npy("<f4", "(24,)", values)],
    ["a cut", npy("<f4", "(2, 3, 4)", values).slice(0, -4)],
    ["no file at all", new ArrayBuffer(200)],
    ["nothing", new ArrayBuffer(0)],
  ])("is refused where it is %s", (_, buffer) => expect(() => readPicture(buffer)).toThrow("reference picture"));
});

const picture = (...pixels: number[]): Picture => ({ width: pixels.length / 4, height: 1, pixels: Float32Array.from(pixels) });

describe("an error", () => {
  it("is counted in levels of linear light", () => {
    const errors = pixelErrors(picture(0.5, 0.5, 0.5, 1, 0, 0, 0, 0), picture(0.5, 0.5, 0.25, 0.5, 0, 0, 0, 0));
    expect(errors.rmse).toBeCloseTo(255 * Math.sqrt(0.0625 / 6), 5);
    expect(errors.max).toBeCloseTo(255 / 4, 5);
    expect(errors.coverage).toBeCloseTo(Math.sqrt(0.25 / 2), 5);
  });

  it("is nothing beyond display white, under black, and where there is no number", () => {
    const errors = pixelErrors(picture(3, -1, NaN, 0), picture(100, 0, 0, 0));
    expect(errors).toEqual({ rmse: 0, max: 0, coverage: 0 });
  });

  it("has all measures, and a map whose root mean square is the whole's", () => {
    const [a, b] = [picture(0.1, 0.2, 0.3, 0, 0.9, 0.8, 0.7, 0), picture(0, 0, 0, 0, 1, 1, 1, 0)];
    const map = errorMap(a, b);
    expect(Math.sqrt(map.reduce((sum, x) => sum + x * x, 0) / map.length)).toBeCloseTo(pixelErrors(a, b).rmse, 4);
    const { flip, ...others } = new ErrorMeter(b, null).errors(a);
    expect(others).toEqual(pixelErrors(a, b));
    expect(flip).toBeGreaterThan(0.05);
    expect(flip).toBeLessThan(1);
  });

  it("needs pictures of one size", () => {
    expect(() => pixelErrors(picture(0, 0, 0, 0), picture(0, 0, 0, 0, 0, 0, 0, 0))).toThrow("1 × 1 pixels, the reference 2 × 1");
  });

  it("has percentiles", () => {
    expect(percentile(Float32Array.from([4, 1, 3, 2]), 0.5)).toBe(3);
    expect(percentile(Float32Array.from([4, 1, 3, 2]), 1)).toBe(4);
  });
});

const at = (id: string, time: number, error: number) => ({ id, time, error });

describe("the Pareto front", () => {
  it("holds what nothing beats in both", () => {
    const points = [at("slow", 9, 1), at("worse", 5, 4), at("fast", 1, 8), at("good", 4, 2), at("equal", 5, 2)];
    expect(paretoFront(points).map(({ id }) => id)).toEqual(["fast", "good", "slow"]);
  });

  it("of equal times holds the more exact", () => {
    expect(paretoFront([at("a", 1, 3), at("b", 1, 2)]).map(({ id }) => id)).toEqual(["b"]);
  });
});

describe("a comparison", () => {
  it.each([
    [[1, 1, 1], [1.8, 1.8, 1.8], 4.3, 1, "1.8× the time, 4.3× less error"],
    [[2, 2, 2], [1, 1, 1], 1, 2, "0.50× the time, 2.0× more error"],
    [[2, 2, 2], [1, 1, 1], 2, 1, "0.50× the time, 2.0× less error"],
    [[1, 1, 1], [20, 20, 20], 2, 2, "20× the time, same error"],
    [[1, 1, 1], [20, 20, 20], 1, 2, "20× the time, 2.0× more error"],
    [[1, 2, 3, 4], [2, 1, 4, 3], 2, 1, "no measurable time difference, 2.0× less error"],
    [[1, 2, 3, 4], [2, 1, 4, 3], 1, 1, "no measurable time difference, same error"],
    [[1, 1, 1], [2, 2, 2], 1e-5, 2e-5, "2.0× the time, same error"],
  ])("of %j and %j ms, %d and %d levels", (before, after, from, to, summary) => {
    expect(compare(before, after, from, to).summary).toBe(summary);
  });

  it("adds the middle of the rounds' differences", () => {
    expect(compare([1, 2, 10], [2, 4, 13], 1, 1).added).toBe(2);
  });
});

describe("numbers", () => {
  it("have quantiles", () => {
    expect(median([3, 1, 2])).toBe(2);
    expect(quantile([4, 1, 2, 3], 0.25)).toBe(1.75);
    expect(median([])).toBeNaN();
  });

  it.each([[0, "0"], [0.01234, "0.012"], [1.234, "1.23"], [12.34, "12.3"], [1234.5, "1235"]])("are short: %d", (value, words) => expect(formatNumber(value)).toBe(words));

  it("are told as factors", () => expect([1.04, 1.84, 12.3].map(formatFactor)).toEqual(["1.04×", "1.8×", "12×"]));

  it("have a model from two sizes", () => {
    expect(fitModel(11, 1000, 2, 100)).toEqual({ fixed: 1, perPixel: 0.01 });
    expect(fitModel(1, 1000, 2, 100)).toEqual({ fixed: 1, perPixel: 0 });
  });

  it("stand on an axis by their logarithms", () => {
    const horizontal = logAxis([1, 10, 100]);
    expect(horizontal.position(10)).toBeCloseTo(0.5, 6);
    expect(horizontal.ticks).toContain(10);
    expect(horizontal.position(0)).toBe(0);
    expect(logAxis([]).ticks.length).toBeGreaterThan(0);
    expect(logAxis([5, 5]).position(5)).toBeCloseTo(0.5, 6);
    expect(horizontal.position(horizontal.low)).toBeCloseTo(0, 6);
    expect(horizontal.position(horizontal.high)).toBeCloseTo(1, 6);
  });

  it.each([[0.001, "0.001"], [20, "20"], [5000, "5k"], [10_000, "10⁴"], [0.00002, "2·10⁻⁵"], [1e12, "10¹²"]])("label a tick %d", (value, label) => {
    expect(tickLabel(value)).toBe(label);
  });

  it("label the ticks that have room", () => {
    const axis = logAxis([1, 1000]);
    const shown = (length: number) => tickLabels(axis, length, 30).filter(Boolean);
    expect(tickLabels(axis, 100, 30)).toHaveLength(axis.ticks.length);
    expect(shown(2000)).toEqual(axis.ticks.map(tickLabel));
    expect(shown(60).length).toBeLessThan(axis.ticks.length);
  });

  it("have colours that grow lighter", () => {
    const light = [0, 0.25, 0.5, 0.75, 1].map((share) => heatColour(share).reduce((a, b) => a + b));
    expect(light).toEqual([...light].sort((a, b) => a - b));
    expect(heatColour(7)).toEqual(heatColour(1));
  });
});

function point(id: string, quality: Point["quality"], parameter: Partial<Point["parameter"]> = null, tier: string | null = null): Point {
  const whole = parameter && { owner: "o", pointer: "/p", title: "t", cause: "c", value: 0, ...parameter };
  return { id, label: id, tier, parameter: whole, quality };
}

describe("a point", () => {
  const standard = point("standard", { a: { b: 1, c: 2 }, d: "x" }, null, "standard");

  it("is asked for by its tier, or by what it changes", () => {
    expect(qualityRequest(standard, standard)).toBe("standard");
    expect(qualityRequest(point("k", { a: { b: 1, c: 9 }, d: "x" }), standard)).toEqual({ a: { c: 9 } });
    expect(parseQuality(JSON.stringify(qualityRequest(point("k", { a: { b: 1, c: 9 }, d: "x" }), standard)))).toEqual({ a: { c: 9 } });
  });

  it("has a title, and survives nonsense", () => {
    expect(qualityTitle('{"a":{"some_parameter":9},"d":"y"}')).toBe("a: some parameter: 9, d: y");
    expect([qualityTitle("high"), parseQuality("high"), parseQuality("{nonsense")]).toEqual(["high", "high", "{nonsense"]);
  });

  it("has the benefit of its setting, the greatest first", () => {
    const timed = (which: Point, rounds: number[], rmse: number) => measuredHere({ point: which, rounds, errors: { rmse, flip: 0, max: 0, coverage: 0 } });
    const list = benefits(timed(standard, [10, 10, 10, 10], 4), [
      timed(standard, [10, 10, 10, 10], 4),
      timed(point("dear", {}, { pointer: "/a/b", value: 3 }), [30, 30, 30, 30], 2),
      timed(point("vain", {}, { pointer: "/a/c", value: 5 }), [12, 12, 12, 12], 5),
      timed(point("cheap", {}, { pointer: "/d", value: "y" }), [5, 5, 5, 5], 9),
      timed(point("noise", {}, { pointer: "/a/b", value: 0 }), [9, 11, 9, 11], 6),
      timed(point("same", {}, { pointer: "/a/b", value: 2 }), [9, 11, 9, 11], 4),
    ]);
    expect(list.map(({ id, from, to, perMs }) => [id, from, to, perMs])).toEqual([
      ["noise", "0", "1", null],
      ["cheap", "y", "x", 1],
      ["dear", "1", "3", 0.1],
      ["same", "1", "2", null],
      ["vain", "2", "5", -0.5],
    ]);
  });
});
