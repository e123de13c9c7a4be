/** Undo, redo, and scenes as text. */
import { expect, test } from "vitest";
import { shortText } from "../../src/edits/edits";
import { EditHistory } from "../../src/edits/history";
import { sceneIn } from "../../src/edits/paste";

const scene = (exposure: number, albedo = 0) => ({ light: { exposure }, foam: { albedo } });

test("edits are undone and redone in order", () => {
  const history = new EditHistory();
  history.record(scene(0), scene(1), 0);
  history.record(scene(1), scene(1, 0.5), 100);
  expect(history.undo(scene(1, 0.5))).toEqual(scene(1));
  expect(history.undo(scene(1))).toEqual(scene(0));
  expect(history.undo(scene(0))).toBeNull();
  expect(history.redo(scene(0))).toEqual(scene(1));
  expect(history.redo(scene(1))).toEqual(scene(1, 0.5));
  expect(history.redo(scene(1, 0.5))).toBeNull();
});

test("a drag is one step, and two slow edits of a field are two", () => {
  const history = new EditHistory();
  history.record(scene(0), scene(1), 0);
  history.record(scene(1), scene(2), 500);
  history.record(scene(2), scene(3), 1000);
  history.record(scene(3), scene(4), 3000);
  expect(history.undo(scene(4))).toEqual(scene(3));
  expect(history.undo(scene(3))).toEqual(scene(0));
  expect(history.canUndo).toBe(false);
});

test("a gesture is one step however slow it is, and two gestures are two however fast", () => {
  const history = new EditHistory();
  history.record(scene(0), scene(1), 0, "touch 1");
  history.record(scene(1), scene(2), 5000, "touch 1");
  history.record(scene(2), scene(3), 5001, "touch 2");
  expect(history.undo(scene(3))).toEqual(scene(2));
  expect(history.undo(scene(2))).toEqual(scene(0));
  expect(history.canUndo).toBe(false);
  history.record(scene(0), scene(1), 5002, "touch 2");
  expect(history.canUndo).toBe(true);
});

test("a gesture that was taken back is no step", () => {
  const history = new EditHistory();
  history.record(scene(0), scene(1), 0, "touch 1");
  history.record(scene(1), scene(2), 10, "touch 2");
  history.record(scene(2), scene(1), 2000, "touch 2");
  expect(history.undo(scene(1))).toEqual(scene(0));
  expect(history.canUndo).toBe(false);
});

test("an edit after an undo forgets what was undone", () => {
  const history = new EditHistory();
  history.record(scene(0), scene(1), 0);
  history.undo(scene(1));
  expect(history.canRedo).toBe(true);
  history.record(scene(0), scene(5), 100);
  expect(history.canRedo).toBe(false);
  expect(history.undo(scene(5))).toEqual(scene(0));
  history.record(scene(0), scene(5), 100);
  history.clear();
  expect(history.canUndo).toBe(false);
});

test("no change is no step", () => {
  const history = new EditHistory();
  history.record(scene(0), scene(0), 0);
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
