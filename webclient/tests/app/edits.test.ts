/** Undo, redo, and scenes as text. */
import { expect, test } from "vitest";
import { EditHistory, sceneIn, shortText } from "../../src/edits/edits";
import type { JsonObject } from "../../src/scene/json";

const scene = (exposure: number, albedo = 0) => ({ light: { exposure }, foam: { albedo } });

type Edit = [before: JsonObject, after: JsonObject, ms: number, gesture?: string];

test.each<[string, Edit[], JsonObject[]]>([
  ["two fields are two steps, however fast", [[scene(0), scene(1), 0], [scene(1), scene(1, 0.5), 100]], [scene(1), scene(0)]],
  ["a drag is one step, and two slow edits of a field are two", [[scene(0), scene(1), 0], [scene(1), scene(2), 500], [scene(2), scene(3), 1000], [scene(3), scene(4), 3000]], [scene(3), scene(0)]],
  ["a gesture is one step however slow, and two are two however fast", [[scene(0), scene(1), 0, "a"], [scene(1), scene(2), 5000, "a"], [scene(2), scene(3), 5001, "b"]], [scene(2), scene(0)]],
  ["a gesture that was taken back is no step", [[scene(0), scene(1), 0, "a"], [scene(1), scene(2), 10, "b"], [scene(2), scene(1), 2000, "b"]], [scene(0)]],
  ["no change is no step", [[scene(0), scene(0), 0]], []],
])("%s", (_, edits, undone) => {
  const history = new EditHistory();
  for (const edit of edits) history.record(...edit);
  const states = [edits.at(-1)?.[1] ?? {}];
  while (history.canUndo) states.unshift(history.undo(states[0] ?? {}) ?? {});
  expect(states.slice(0, -1).reverse()).toEqual(undone);
  expect(history.undo({})).toBeNull();
  for (const [i, next] of states.slice(1).entries()) expect(history.redo(states[i] ?? {})).toEqual(next);
  expect(history.redo({})).toBeNull();
});

test("an edit after an undo is a step of its own, and forgets what was undone", () => {
  const history = new EditHistory();
  history.record(scene(0), scene(1), 0, "a");
  history.undo(scene(1));
  expect([history.canUndo, history.canRedo]).toEqual([false, true]);
  history.record(scene(0), scene(5), 100, "a");
  expect([history.canUndo, history.canRedo]).toEqual([true, false]);
  history.clear();
  expect(history.canUndo).toBe(false);
});

test("a pasted text is a scene, or has one", () => {
  expect(sceneIn('{"light": {"exposure": 1}}')).toEqual({ light: { exposure: 1 } });
  expect(sceneIn('{"name": "storm", "scene": {"foam": {}}}')).toEqual({ foam: {} });
  expect(() => sceneIn("{")).toThrow(SyntaxError);
  expect(() => sceneIn("[1]")).toThrow("A scene is a JSON object.");
});

test("values are told in a few words", () => {
  expect(shortText(1 / 3)).toBe("0.3333");
  expect(shortText(undefined)).toBe("absent");
  expect(shortText("vac-24")).toBe("vac-24");
  expect(shortText(Array.from({ length: 40 }, () => 1))).toMatch(/^\[1,1.*…$/);
});
