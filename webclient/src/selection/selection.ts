/** What the user has selected, with change events: a preset, its edited scene, a quality, and perhaps two values of one field side by side. */
import type { Choice, Preset } from "../api";
import type { PlanRequest } from "../display/planloader";
import { get, type Json, type JsonObject, parsed, steps, withValue } from "../scene/json";

export const DEFAULT_TIER = "standard";
/** The field of a split that compares qualities; all others are pointers into the scene. */
export const QUALITY_FIELD = "quality";

/** Two values of one field side by side. */
export interface Split {
  field: string; // Scene pointer, or `QUALITY_FIELD`
  left: string;
  right: string;
  at: number; // Position of the divider, as a share of the width
}

/** A field that two values of can be compared. */
export interface ComparableField { field: string; title: string; options: readonly Choice[]; }

export interface Selection {
  preset: Preset;
  scene: JsonObject;
  quality: string; // A tier, or quality settings as JSON
  auto: boolean; // Whether the page selects the quality
  split: Split | null;
}

/** The split, if the scene has its field. */
export function validSplit(scene: JsonObject, split: Split | null): Split | null {
  return split && (split.field === QUALITY_FIELD || typeof get(scene, split.field) === "string") ? split : null;
}

/** Quality for a request; the server reports what is no JSON. */
export const parseQuality = (text: string): Json => (text.startsWith("{") ? (parsed(text) ?? text) : text);

export function qualityTitle(text: string): string {
  return text.startsWith("{") ? text.replace(/[{}"]/g, "").replace(/[:,]/g, "$& ").replaceAll("_", " ") : text;
}

type SelectionListener = (now: Selection, before: Selection, gesture?: string) => void;

export class Store {
  private readonly listeners = new Set<SelectionListener>();

  constructor(private selection: Selection) {}

  get now(): Selection { return this.selection; }

  /** `gesture`: names the pointer gesture that makes the change; all its changes are one step of undo. */
  set(change: Partial<Selection>, gesture?: string): void {
    const before = this.selection;
    this.selection = { ...before, ...change };
    for (const listener of this.listeners) listener(this.selection, before, gesture);
  }

  onChange(listener: SelectionListener): void {
    this.listeners.add(listener);
  }
}

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
