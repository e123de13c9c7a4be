import { describe, expect, it } from "vitest";
import { isLive, liveRule, planCovers } from "../../src/plan/rules";
import { apply, diff, type JsonObject, withValue } from "../../src/scene/json";

const plan = { live: ["/light/exposure", "/water/absorption_length"] };

const scene: JsonObject = {
  waves: [{ amplitude: 1 }],
  light: { exposure: 0, turbidity: 2 },
  water: { absorption_length: [7, 30, 70] },
  camera: { yaw: 0 },
};

describe("a plan serves", () => {
  it("every live field and every camera", () => {
    const other = apply(scene, [["/light/exposure", 2], ["/water/absorption_length/1", 20], ["/camera/yaw", 1]]);
    expect(planCovers(plan, scene, other)).toBe(true);
  });

  it.each([["/light/turbidity", 3], ["/light", null], ["/waves", []], ["/light/exposures", 1], ["/light/exposure", null]] as const)("no other change: %s", (pointer, value) => {
    expect(planCovers(plan, scene, withValue(scene, pointer, value as never))).toBe(false);
  });
});

describe("a live rule", () => {
  const rule = { rule: "constant" as const, value: [7, 30, 70], field: "/water/absorption_length" };

  it("takes the scene's numbers", () => {
    expect(liveRule(rule, withValue(scene, "/water/absorption_length/0", 9))).toMatchObject({ value: [9, 30, 70] });
    const exposure = { ...rule, value: [0], field: "/light/exposure" };
    expect(liveRule(exposure, withValue(scene, "/light/exposure", -1))).toMatchObject({ value: [-1] });
  });

  it("keeps the plan's where the scene has no such numbers", () => {
    expect(liveRule(rule, withValue(scene, "/water/absorption_length", [1, 2]))).toBe(rule);
    expect(liveRule(rule, withValue(scene, "/water", null))).toBe(rule);
    expect(liveRule(rule, null)).toBe(rule);
    expect(liveRule({ ...rule, field: null }, scene)).toMatchObject({ value: [7, 30, 70] });
  });
});

describe("differences", () => {
  it("lead from one scene to the other", () => {
    const other: JsonObject = { waves: [], light: null, water: { absorption_length: [7, 30, 71], new: {} } };
    expect(apply(scene, diff(scene, other))).toEqual(other);
    expect(diff(scene, scene)).toEqual([]);
  });

  it("name what changed and no more", () => {
    expect(diff(scene, withValue(scene, "/waves/0/amplitude", 2))).toEqual([["/waves/0/amplitude", 2]]);
    expect(diff(scene, withValue(scene, "/camera", undefined))).toEqual([["/camera", undefined]]);
  });

  it("escape the keys of pointers", () => {
    const odd = { "a/b~c": { d: 1 } };
    expect(diff(odd, withValue(odd, "/a~1b~0c/d", 2))).toEqual([["/a~1b~0c/d", 2]]);
  });

  describe("of a list that can change", () => {
    const strength = { rule: "constant" as const, value: [0.3], field: "/touches/1/strength", absent: [0] };
    const fixed = { rule: "clamp" as const, offset: 7, rate: -2, k: [1, 0] as [number, number], low: -1e8, high: 1e8 };
    const place = { ...fixed, terms: [{ field: "/touches/1/place/0", factor: -1 }, { field: "/touches/1/time", factor: 2 }] };
    const touched = (count: number) => ({ touches: Array.from({ length: count }, (_, i) => ({ place: [i + 0.5, 3], time: 10 * i, strength: 0.1 })) });

    it("has the element's numbers, or those of none", () => {
      expect(liveRule(strength, touched(2))).toMatchObject({ value: [0.1] });
      expect(liveRule(strength, touched(1))).toMatchObject({ value: [0] });
      expect(liveRule(strength, {})).toMatchObject({ value: [0] });
    });

    it("adds the terms of an offset, and keeps it where one is absent", () => {
      expect(liveRule(place, touched(2))).toMatchObject({ offset: -1.5 + 20, rate: -2 });
      expect(liveRule(place, touched(1))).toMatchObject({ offset: 7 });
      expect(liveRule(fixed, touched(2))).toMatchObject({ offset: 7 });
    });

    it("is told from rules that never change", () => {
      expect([isLive(strength), isLive(place)]).toEqual([true, true]);
      expect([isLive(fixed), isLive({ rule: "constant", value: [1] })]).toEqual([false, false]);
    });

    it("is covered whatever its length", () => {
      const list = { live: ["/touches"] };
      expect(planCovers(list, touched(2), touched(1))).toBe(true);
      expect(planCovers(list, touched(1), { touches: [] })).toBe(true);
      expect(planCovers(plan, { touches: [] }, touched(1))).toBe(false);
    });
  });
});
