/** Split view: two values of one field side by side. The field is a scene pointer, or `QUALITY_FIELD`. */
import type { PlanRequest } from "../display/planloader";
import { get, type Json, steps, withValue } from "../scene/json";
import type { ComparableField } from "../ui/splitview";
import { parseQuality, QUALITY_FIELD, type Selection, type Split } from "./selection";

/** The split after a field was edited: its right side follows the scene. */
export function splitAfterEdit(split: Split | null, field: string, value: Json): Split | null {
  return split?.field === field && typeof value === "string" ? { ...split, right: value } : split;
}

/** A split of this field: right the current value, left the first other one. */
export function startSplit({ scene, quality, split }: Selection, { field, options }: ComparableField): Split {
  const current = field === QUALITY_FIELD ? quality : get(scene, field);
  const right = typeof current === "string" ? current : (options.at(-1)?.name ?? "");
  const left = options.find(({ name }) => name !== right)?.name ?? right;
  return { field, left, right, at: split?.at ?? 0.5 };
}

/** The field to compare first: the scene's own one with the most options; fields of list items and the quality come last. */
export function preferredField(fields: readonly ComparableField[]): ComparableField | undefined {
  const isOwn = ({ field }: ComparableField) => field !== QUALITY_FIELD && steps(field).every((step) => !/^\d+$/.test(step));
  return [...fields].sort((a, b) => Number(isOwn(b)) - Number(isOwn(a)) || b.options.length - a.options.length)[0];
}

/** The plan request of one side; without a split, of the whole picture. */
export function planRequest({ scene, quality, split }: Selection, side: "left" | "right"): PlanRequest {
  const request = { scene, quality: parseQuality(quality) };
  if (split === null) return request;
  if (split.field === QUALITY_FIELD) return { ...request, quality: parseQuality(split[side]) };
  return { ...request, scene: withValue(scene, split.field, split[side]) };
}
