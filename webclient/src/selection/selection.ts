/** What the user has selected: a preset, its edited scene, a quality, and perhaps two values side by side. */
import type { Preset } from "../api";
import { get, type Json, type JsonObject } from "../scene/json";

export const DEFAULT_TIER = "standard";
/** The field of a split that compares qualities; all others are pointers into the scene. */
export const QUALITY_FIELD = "quality";

/** Two values of one field side by side. */
export interface Split {
  /** Scene pointer, or `QUALITY_FIELD`. */
  field: string;
  left: string;
  right: string;
  /** Position of the divider, as a share of the width. */
  at: number;
}

export interface Selection {
  preset: Preset;
  scene: JsonObject;
  /** A tier, or quality settings as JSON. */
  quality: string;
  /** Whether the page selects the quality. */
  auto: boolean;
  split: Split | null;
}

/** The split, if the scene has its field. */
export function validSplit(scene: JsonObject, split: Split | null): Split | null {
  return split && (split.field === QUALITY_FIELD || typeof get(scene, split.field) === "string") ? split : null;
}

/** Quality for a request. */
export function parseQuality(text: string): Json {
  if (!text.startsWith("{")) return text;
  try {
    return JSON.parse(text) as Json;
  } catch {
    // The server reports the error.
    return text;
  }
}

export function qualityTitle(text: string): string {
  return text.startsWith("{") ? text.replace(/[{}"]/g, "").replace(/[:,]/g, "$& ").replaceAll("_", " ") : text;
}
