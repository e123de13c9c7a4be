/** What the visitor has chosen, and who wants to know when it changes. Time and camera move every frame and live apart. */
import type { Preset } from "../api";
import type { JsonObject } from "../scene/json";

/** Two values of one choice side by side: `field` is a scene pointer, or "quality". */
export interface Split {
  field: string;
  left: string;
  right: string;
  /** Where the divider stands, as a share of the width. */
  at: number;
}

export interface Choices {
  preset: Preset;
  scene: JsonObject;
  /** A tier, or single knobs as JSON. */
  quality: string;
  /** Whether the page may change the quality, to what the machine draws best in time. */
  auto: boolean;
  split: Split | null;
}

export class Store {
  private readonly listeners = new Set<(now: Choices, before: Choices) => void>();

  constructor(private choices: Choices) {}

  get now(): Choices {
    return this.choices;
  }

  set(change: Partial<Choices>): void {
    const before = this.choices;
    this.choices = { ...before, ...change };
    for (const listener of this.listeners) listener(this.choices, before);
  }

  onChange(listener: (now: Choices, before: Choices) => void): void {
    this.listeners.add(listener);
  }
}
