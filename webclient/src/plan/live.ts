/** Live fields: scene fields whose values are uniforms, so that a change needs no new plan. */
import type { FramePlan } from "../generated/api";
import { diff, get, type Json } from "../scene/json";
import type { Rule } from "./rules";

/** The camera's pointer in a scene: every plan covers every camera. */
export const CAMERA_POINTER = "/camera";

const isWithin = (pointer: string, field: string) => pointer === field || pointer.startsWith(`${field}/`);

/** Whether the plan of one scene also draws another. A field that becomes null has no number of its own to draw with. */
export function planCovers(plan: Pick<FramePlan, "live">, planned: Json, requested: Json): boolean {
  return diff(planned, requested).every(([pointer, value]) =>
    value !== null && [CAMERA_POINTER, ...plan.live].some((field) => isWithin(pointer, field)),
  );
}

/** Whether a rule has numbers that follow the scene's fields. */
export function isLive(rule: Rule): boolean {
  return (rule.rule === "constant" && typeof rule.field === "string") || (rule.rule === "clamp" && (rule.terms ?? []).length > 0);
}

/** The rule with the scene's numbers, if the scene has all that it names; else as the plan says for where they are absent. */
export function liveRule(rule: Rule, scene: Json | null): Rule {
  if (scene === null) return rule;
  if (rule.rule === "clamp") return { ...rule, offset: offset(rule.terms ?? [], scene) ?? rule.offset };
  if (rule.rule !== "constant" || typeof rule.field !== "string") return rule;
  const value = get(scene, rule.field);
  if (value === undefined && rule.absent) return { ...rule, value: rule.absent };
  const numbers = Array.isArray(value) ? value : [value];
  return numbers.length === rule.value.length && numbers.every((n) => typeof n === "number")
    ? { ...rule, value: numbers }
    : rule;
}

/** The sum of the terms in their order, as the server adds them; null where the scene lacks one of their fields. */
function offset(terms: readonly { field: string; factor: number }[], scene: Json): number | null {
  let sum = 0;
  for (const { field, factor } of terms) {
    const value = get(scene, field);
    if (typeof value !== "number") return null;
    sum += factor * value;
  }
  return terms.length > 0 ? sum : null;
}
