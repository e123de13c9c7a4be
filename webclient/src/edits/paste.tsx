/** A field for a scene as JSON, with what the server finds wrong with it. */
import { useSignal } from "@preact/signals";
import { isObject, type Json, type JsonObject } from "../scene/json";

interface PasteProps {
  /** Resolves with what is wrong with the scene; empty if it was put in place. */
  apply: (scene: JsonObject) => Promise<string[]>;
}

/** The scene in a JSON text: a scene, or an object that has one at `scene`, such as a preset or a request. Throws a `SyntaxError`. */
export function sceneIn(text: string): JsonObject {
  const value = JSON.parse(text) as Json;
  if (!isObject(value)) throw new SyntaxError("A scene is a JSON object.");
  const inner = value["scene"];
  return isObject(inner) ? inner : value;
}

export function PasteForm({ apply }: PasteProps) {
  const text = useSignal("");
  const problems = useSignal<string[]>([]);
  const submit = async (event: Event) => {
    event.preventDefault();
    try {
      problems.value = await apply(sceneIn(text.value));
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
        {problems.value.map((problem) => (
          <p key={problem} class="mb-1 text-fine wrap-anywhere text-error">{problem}</p>
        ))}
      </div>
      <button type="submit" class="button" disabled={text.value.trim() === ""}>
        Apply
      </button>
    </form>
  );
}
