/** Scenes as text: for the clipboard, and from it. */
import { isObject, type Json, type JsonObject } from "../scene/json";

/** The scene in a JSON text: a scene, or an object that has one at `scene`, such as a preset or a request. Throws a `SyntaxError`. */
export function sceneIn(text: string): JsonObject {
  const value = JSON.parse(text) as Json;
  if (!isObject(value)) throw new SyntaxError("A scene is a JSON object.");
  const inner = value["scene"];
  return isObject(inner) ? inner : value;
}

/** A value in a few words. */
export function shortText(value: Json | undefined): string {
  if (value === undefined || value === null) return "absent";
  if (typeof value === "number") return String(Number(value.toPrecision(4)));
  if (typeof value === "string") return value;
  const text = JSON.stringify(value);
  return text.length <= 32 ? text : `${text.slice(0, 31)}…`;
}
