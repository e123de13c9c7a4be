import { describe, expect, it } from "vitest";
import { evaluate, fill, type FrameState, type Rule } from "../../src/plan/rules";
import { golden as read } from "../golden";

interface Golden {
  rule: Rule;
  state: Pick<FrameState, "time" | "camera" | "width" | "height"> & Record<"target_width" | "target_height", number>;
  value: number[];
}

const golden = read("uniform_rules") as Golden[];

const frame = ({ target_width, target_height, ...state }: Golden["state"]): FrameState => ({
  ...state,
  targetWidth: target_width,
  targetHeight: target_height,
});

describe("uniform rules agree with the server's", () => {
  it("has vectors of every rule", () => {
    const kinds = new Set(golden.map(({ rule }) => rule.rule));
    expect(kinds).toEqual(new Set(["constant", "phase", "wrap", "loop", "clamp", "camera", "viewport"]));
  });

  it.each(golden.map((vector, i) => [`${i} ${vector.rule.rule}`, vector] as const))("%s", (_, { rule, state, value }) => {
    const ours = evaluate(rule, frame(state));
    expect(ours).toHaveLength(value.length);
    value.forEach((theirs, i) => {
      // sin, cos and tan of two mathematics libraries may differ in the last bit of a float64, never in a float32's.
      const mine = ours[i] ?? NaN;
      const ulp = Math.max(Math.abs(Math.fround(theirs)) * 2 ** -23, 2 ** -149);
      expect(Math.abs(Math.fround(mine) - Math.fround(theirs))).toBeLessThanOrEqual(rule.rule === "camera" ? Math.max(ulp, 1e-12) : 0);
    });
  });
});

describe("edges of the reductions", () => {
  const camera = { position: [0, 1, 0], yaw: 0, pitch: 0, roll: 0, fov: 1 } as const;
  const still: FrameState = { time: 0, camera, width: 2, height: 1, targetWidth: 2, targetHeight: 1 };

  it("never gives the period itself", () => {
    const tiny = { ...still, time: -1e-300 };
    expect(evaluate({ rule: "loop", period: 7, offset: 0 }, tiny)).toEqual([0]);
    expect(evaluate({ rule: "wrap", k: [0, 0], offset: -1e-300, period: 1 }, still)).toEqual([0]);
  });

  it("keeps phases within a turn after a thousand million seconds", () => {
    for (const time of [1e9, -1e9]) {
      const [phase] = evaluate({ rule: "phase", offset: 1, rate: 2.3, k: [0.5, 0.1] }, { ...still, time });
      expect(Math.abs(phase ?? NaN)).toBeLessThanOrEqual(Math.PI);
    }
  });

  it("refuses rules that do not fill the uniform", () => {
    const rules: Rule[] = [{ rule: "constant", value: [1], field: null }];
    expect(() => fill(rules, still, new Float32Array(2))).toThrow(RangeError);
    expect(() => fill(rules, still, new Float32Array(0))).toThrow(RangeError);
  });
});
