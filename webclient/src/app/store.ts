/** The user's selection, with change events. Time and camera change every frame and are kept elsewhere. */
import type { Preset } from "../api";
import { apply, type Change, isObject, type JsonObject } from "../scene/json";
import { toJson, TOUCHES_POINTER } from "../touch/touches";
import { validSplit } from "./comparison";
import { DEFAULT_TIER } from "./schema";
import type { LinkState } from "./url";

/** Two values of one field side by side. */
export interface Split {
  /** Scene pointer, or "quality". */
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

export function selectionFromLink(preset: Preset, link: LinkState): Selection {
  const touches: Change[] = link.touches ? [[TOUCHES_POINTER, toJson(link.touches)]] : [];
  const edited = apply(preset.scene, [...link.changes, ...touches]);
  const scene = isObject(edited) ? edited : preset.scene;
  return { preset, scene, quality: link.quality ?? DEFAULT_TIER, auto: link.quality === null, split: validSplit(scene, link.split) };
}

export type SelectionListener = (now: Selection, before: Selection, gesture?: string) => void;

export class Store {
  private readonly listeners = new Set<SelectionListener>();

  constructor(private selection: Selection) {}

  get now(): Selection {
    return this.selection;
  }

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
