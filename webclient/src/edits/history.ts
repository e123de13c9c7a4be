/** Undo and redo of the scene's edits. */
import { diff, type JsonObject } from "../scene/json";

/** Edits of one field that follow each other faster than this are one step, ms: a slider's drag. */
const JOINED = 800;
const LIMIT = 200;

export class EditHistory {
  private past: JsonObject[] = [];
  private future: JsonObject[] = [];
  private last = { fields: "", at: -Infinity };

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** Notes an edit; `now`: ms. */
  record(before: JsonObject, after: JsonObject, now: number): void {
    const fields = diff(before, after).map(([pointer]) => pointer).join(" ");
    if (fields === "") return;
    if (fields !== this.last.fields || now - this.last.at > JOINED) this.past = [...this.past, before].slice(-LIMIT);
    this.future = [];
    this.last = { fields, at: now };
  }

  /** The scene before the last edit of `current`, or null. */
  undo(current: JsonObject): JsonObject | null {
    const scene = this.past.pop() ?? null;
    if (scene) this.future.push(current);
    this.last.at = -Infinity;
    return scene;
  }

  /** The scene that was undone last, or null. */
  redo(current: JsonObject): JsonObject | null {
    const scene = this.future.pop() ?? null;
    if (scene) this.past.push(current);
    this.last.at = -Infinity;
    return scene;
  }

  clear(): void {
    this.past = [];
    this.future = [];
    this.last.at = -Infinity;
  }
}
