/** The edits of the scene: undo and redo, what differs from the preset, and the scene as JSON. */
import { type Signal, signal, useSignal } from "@preact/signals";
import { type ButtonHTMLAttributes, render } from "preact";
import { type Api, ApiError } from "../api";
import { apply, diff, equal, get, isObject, type Json, type JsonObject } from "../scene/json";
import { type Selection, type Store, validSplit } from "../selection/selection";
import { copyText } from "../ui/dom";
import { Icon } from "../ui/icons";

const JOINED = 800; // Edits of one field that follow each other faster than this are one step, ms: a slider's drag
const LIMIT = 200;

export class EditHistory {
  private past: JsonObject[] = [];
  private future: JsonObject[] = [];
  private last = { step: "", at: -Infinity };

  get canUndo(): boolean { return this.past.length > 0; }

  get canRedo(): boolean { return this.future.length > 0; }

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
  readonly undo = (current: JsonObject): JsonObject | null => this.step(this.past, this.future, current);

  /** The scene that was undone last, or null. */
  readonly redo = (current: JsonObject): JsonObject | null => this.step(this.future, this.past, current);

  private step(from: JsonObject[], to: JsonObject[], current: JsonObject): JsonObject | null {
    const scene = from.pop() ?? null;
    if (scene) to.push(current);
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

interface SceneEditsEvents {
  /** A scene from elsewhere was put in place; its camera is to be taken. */
  pasted: (scene: JsonObject) => void;
  /** A word on what was done. */
  note: (text: string) => void;
}

export class SceneEdits {
  private readonly history = new EditHistory();
  private readonly selection: Signal<Selection>; // The store's selection, for the view to follow
  private readonly pasting = signal(false);
  private restoring = false;

  constructor(container: HTMLElement, private readonly api: Api, private readonly store: Store, private readonly events: SceneEditsEvents) {
    this.selection = signal(store.now);
    store.onChange((now, before, gesture) => {
      if (now.scene === before.scene && now.preset === before.preset) return;
      if (now.preset.name !== before.preset.name) this.history.clear();
      else if (!this.restoring) this.history.record(before.scene, now.scene, performance.now(), gesture);
      this.selection.value = now;
    });
    document.addEventListener("keydown", this.keyDown);
    render(<this.View />, container);
  }

  private step(way: "undo" | "redo"): void {
    const scene = this.history[way](this.store.now.scene);
    if (scene === null) return;
    this.restoring = true;
    this.put(scene);
    this.restoring = false;
  }

  private put(scene: JsonObject): void {
    this.store.set({ scene, split: validSplit(scene, this.store.now.split) });
  }

  private readonly keyDown = (event: KeyboardEvent): void => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    // Text fields undo their own typing.
    if (event.target instanceof HTMLElement && event.target.matches("input:not([type=range]), textarea")) return;
    const key = event.key.toLowerCase();
    const redo = (key === "z" && event.shiftKey) || (key === "y" && !event.shiftKey);
    if (!redo && key !== "z") return;
    event.preventDefault();
    this.step(redo ? "redo" : "undo");
  };

  private revert(pointer: string): void {
    const { preset, scene } = this.store.now;
    const reverted = apply(scene, [[pointer, get(preset.scene, pointer)]]);
    if (isObject(reverted)) this.put(reverted);
  }

  private async copy(): Promise<void> {
    const copied = await copyText(JSON.stringify(this.store.now.scene, null, 2));
    this.events.note(copied ? "Scene copied as JSON." : "Clipboard access denied.");
  }

  /** Puts a scene in place once the server has checked and completed it; returns what is wrong with it. */
  private readonly paste = async (scene: JsonObject): Promise<string[]> => {
    try {
      const completed = await this.api.completeScene(scene);
      this.pasting.value = false;
      this.put(completed);
      this.events.pasted(completed);
      return [];
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      return error.details.length > 0 ? [...error.details] : [error.message];
    }
  };

  private readonly View = () => {
    const { preset, scene } = this.selection.value;
    const changes = diff(preset.scene, scene);
    return (
      <>
        <div class="grid grid-cols-2 gap-2 border-t border-line py-2.5">
          <Button name="Undo" title="Undo (Ctrl+Z)" disabled={!this.history.canUndo} onClick={() => this.step("undo")} />
          <Button name="Redo" title="Redo (Ctrl+Shift+Z)" disabled={!this.history.canRedo} onClick={() => this.step("redo")} />
          <Button name="Copy scene" title="Copy the scene as JSON" onClick={() => void this.copy()} />
          <Button name="Paste scene" aria-expanded={this.pasting.value} onClick={() => (this.pasting.value = !this.pasting.value)} />
        </div>
        {this.pasting.value && <PasteForm put={this.paste} />}
        <details class="disclosure changes px-1.5">
          <summary>{changes.length === 0 ? "no change from the preset" : `${changes.length} changed from the preset`}</summary>
          <ul class="mb-3 text-fine text-soft">
            {changes.map(([pointer, value]) => (
              <li key={pointer} class="grid grid-cols-[1fr_44px] items-center py-0.5">
                <code class="text-small/[1.4] wrap-anywhere text-ink">{pointer}</code>
                <span class="col-1 wrap-anywhere">{shortText(get(preset.scene, pointer))} → {shortText(value)}</span>
                <button type="button" class="plain col-2 row-[1/3]" aria-label={`Revert ${pointer}`} title="Revert" onClick={() => this.revert(pointer)}>
                  <Icon name="reset" />
                </button>
              </li>
            ))}
          </ul>
        </details>
      </>
    );
  };
}

function Button({ name, ...attributes }: { name: string } & ButtonHTMLAttributes) {
  return <button type="button" class="button" {...attributes}>{name}</button>;
}

/** A value in a few words. */
export function shortText(value: Json | undefined): string {
  if (value === undefined || value === null) return "absent";
  if (typeof value === "number") return String(Number(value.toPrecision(4)));
  if (typeof value === "string") return value;
  const text = JSON.stringify(value);
  return text.length <= 32 ? text : `${text.slice(0, 31)}…`;
}

/** The scene in a JSON text: a scene, or an object that has one at `scene`, such as a preset or a request. Throws a `SyntaxError`. */
export function sceneIn(text: string): JsonObject {
  const value = JSON.parse(text) as Json;
  if (!isObject(value)) throw new SyntaxError("A scene is a JSON object.");
  const inner = value["scene"];
  return isObject(inner) ? inner : value;
}

/** A field for a scene as JSON, with what the server finds wrong with it. `put`: resolves with that; empty if the scene was put in place. */
function PasteForm({ put }: { put: (scene: JsonObject) => Promise<string[]> }) {
  const text = useSignal("");
  const problems = useSignal<string[]>([]);
  const submit = async (event: Event) => {
    event.preventDefault();
    try {
      problems.value = await put(sceneIn(text.value));
    } catch (error) {
      problems.value = [error instanceof SyntaxError ? `Not JSON: ${error.message}` : String(error)];
    }
  };
  return (
    <form class="paste grid gap-2 pb-3" onSubmit={(event) => void submit(event)}>
      <textarea
        rows={6}
        class="w-full resize-y rounded-md border border-line bg-hover px-2.5 py-2 font-mono text-small/[1.5]"
        spellcheck={false}
        aria-label="Scene as JSON"
        aria-invalid={problems.value.length > 0}
        placeholder='{"light": {"exposure": -1}}'
        value={text.value}
        onInput={(event) => (text.value = event.currentTarget.value)}
      />
      <div role="alert">
        {problems.value.map((problem) => <p key={problem} class="mb-1 text-fine wrap-anywhere text-error">{problem}</p>)}
      </div>
      <button type="submit" class="button" disabled={text.value.trim() === ""}>Apply</button>
    </form>
  );
}
