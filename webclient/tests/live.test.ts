import { describe, expect, it } from "vitest";
import type { FramePlan } from "../src/generated/api";
import { liveRule, planCovers } from "../src/plan/live";
import { apply, diff, type JsonObject, withValue } from "../src/scene/json";

const plan: FramePlan = {
  version: 1,
  effects: [],
  skipped: [],
  programs: {},
  textures: {},
  targets: {},
  passes: [],
  kept: {},
  uniforms: {},
  linear: "linear",
  samples: 1,
  top: 0,
  bottom: -100,
  live: ["/light/exposure", "/water/absorption_length"],
};

const scene: JsonObject = {
  waves: [{ amplitude: 1 }],
  light: { exposure: 0, turbidity: 2 },
  water: { absorption_length: [7, 30, 70] },
  camera: { yaw: 0 },
};

describe("a plan serves", () => {
  it("every live field and every camera", () => {
    const other = apply(scene, [
      ["/light/exposure", 2],
      ["/water/absorption_length/1", 20],
      ["/camera/yaw", 1],
    ]);
    expect(planCovers(plan, scene, other)).toBe(true);
  });

  it.each([
    ["/light/turbidity", 3],
    ["/light", null],
    ["/waves", []],
    ["/light/exposures", 1],
  ] as const)("no other change: %s", (pointer, value) => {
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
});
