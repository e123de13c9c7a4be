/** Live fields: scene fields that stand in the plan as they are, so that a moved slider moves its uniform at once. */
import type { FramePlan } from "../generated/api";
import { diff, get, type Json } from "../scene/json";
import type { Rule } from "./rules";

/** Pointer of the camera in a scene. Every plan serves every camera, so the camera never asks for a new one. */
export const CAMERA_POINTER = "/camera";

const isWithin = (pointer: string, field: string) => pointer === field || pointer.startsWith(`${field}/`);

/** Whether a plan made for one scene also draws another. */
export function planCovers(plan: FramePlan, planned: Json, wanted: Json): boolean {
  return diff(planned, wanted).every(([pointer]) =>
    [CAMERA_POINTER, ...plan.live].some((field) => isWithin(pointer, field)),
  );
}

/** A constant's numbers: the scene's own where the rule names a field that holds as many, else the plan's. */
export function liveRule(rule: Rule, scene: Json | null): Rule {
  if (rule.rule !== "constant" || typeof rule.field !== "string" || scene === null) return rule;
  const value = get(scene, rule.field);
  const numbers = Array.isArray(value) ? value : [value];
  return numbers.length === rule.value.length && numbers.every((n) => typeof n === "number")
    ? { ...rule, value: numbers }
    : rule;
}
