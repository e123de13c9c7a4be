/** Live fields: scene fields whose values are uniforms, so that a change needs no new plan. */
import type { FramePlan } from "../generated/api";
import { diff, get, type Json } from "../scene/json";
import type { Rule } from "./rules";

/** The camera's pointer in a scene: every plan covers every camera. */
export const CAMERA_POINTER = "/camera";

const isWithin = (pointer: string, field: string) => pointer === field || pointer.startsWith(`${field}/`);

/** Whether the plan of one scene also draws another. */
export function planCovers(plan: FramePlan, planned: Json, requested: Json): boolean {
  return diff(planned, requested).every(([pointer]) =>
    [CAMERA_POINTER, ...plan.live].some((field) => isWithin(pointer, field)),
  );
}

/** A constant rule with the scene's numbers, if it names a field with as many; else the rule itself. */
export function liveRule(rule: Rule, scene: Json | null): Rule {
  if (rule.rule !== "constant" || typeof rule.field !== "string" || scene === null) return rule;
  const value = get(scene, rule.field);
  const numbers = Array.isArray(value) ? value : [value];
  return numbers.length === rule.value.length && numbers.every((n) => typeof n === "number")
    ? { ...rule, value: numbers }
    : rule;
}
