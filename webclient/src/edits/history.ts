/** Undo and redo of the scene's edits. */
import { diff, equal, type JsonObject } from "../scene/json";

/** Edits of one field that follow each other faster than this are one step, ms: a slider's drag. */
const JOINED = 800;
const LIMIT = 200;

export class EditHistory {
  private past: JsonObject[] = [];
  private future: JsonObject[] = [];
  private last = { step: "", at: -Infinity };

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /**
   * Notes an edit; `now`: ms. `gesture`: the pointer gesture that made it. A gesture is one step, however long it takes;
   * without one, edits are joined by field and time.
   */
  record(before: JsonObject, after: JsonObject, now: number, gesture?: string): void {
    const fields = diff(before, after).map(([pointer]) => pointer).join(" ");
    if (fields === "") return;
    const step = gesture ?? fields;
    const joined = step === this.last.step && (gesture !== undefined || now - this.last.at <= JOINED);
    if (!joined) this.past = [...this.past, before].slice(-LIMIT);
    this.future = [];
    this.last = { step, at: now };
    if (joined && equal(this.past.at(-1), after)) {
      // The gesture was taken back: there is nothing to undo.
      this.past.pop();
      this.endStep();
    }
  }

  /** The scene before the last edit of `current`, or null. */
  undo(current: JsonObject): JsonObject | null {
    const scene = this.past.pop() ?? null;
    if (scene) this.future.push(current);
    this.endStep();
    return scene;
  }

  /** The scene that was undone last, or null. */
  redo(current: JsonObject): JsonObject | null {
    const scene = this.future.pop() ?? null;
    if (scene) this.past.push(current);
    this.endStep();
    return scene;
  }

  clear(): void {
    this.past = [];
    this.future = [];
    this.endStep();
  }

  private endStep(): void {
    this.last = { step: "", at: -Infinity };
  }
}
