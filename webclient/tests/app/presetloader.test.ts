import { expect, test } from "vitest";
import type { Api, Preset } from "../../src/api";
import { PresetLoader } from "../../src/app/address";

const preset = (name: string): Preset => ({ name, title: name, summary: "", size: [1, 1], time: 0, scene: {} });

function fixture() {
  const waiting = new Map<string, { resolve: (preset: Preset) => void; reject: (error: unknown) => void }>();
  const api = { preset: (name: string) => new Promise((resolve, reject) => waiting.set(name, { resolve, reject })) };
  const state = { busy: false };
  const loader = new PresetLoader(api as unknown as Api, () => preset("swell"), (busy) => (state.busy = busy));
  return { waiting, loader, state };
}

test("is busy until the preset is there", async () => {
  const { waiting, loader, state } = fixture();
  const loading = loader.load("storm");
  expect(state.busy).toBe(true);
  waiting.get("storm")?.resolve(preset("storm"));
  expect((await loading)?.name).toBe("storm");
  expect(state.busy).toBe(false);
});

test("of two the later is shown, though it comes first", async () => {
  const { waiting, loader, state } = fixture();
  const [first, second] = [loader.load("storm"), loader.load("beach")];
  waiting.get("beach")?.resolve(preset("beach"));
  expect((await second)?.name).toBe("beach");
  expect(state.busy).toBe(false);
  waiting.get("storm")?.resolve(preset("storm"));
  expect(await first).toBeNull();
});

test("the one on the page is there at once, and no earlier one is shown after it", async () => {
  const { waiting, loader, state } = fixture();
  const first = loader.load("storm");
  expect((await loader.load("swell"))?.name).toBe("swell");
  expect(state.busy).toBe(false);
  waiting.get("storm")?.reject(new Error("away"));
  expect(await first).toBeNull();
});

test("a failure is told", async () => {
  const { waiting, loader, state } = fixture();
  const loading = loader.load("storm");
  waiting.get("storm")?.reject(new Error("away"));
  await expect(loading).rejects.toThrow("away");
  expect(state.busy).toBe(false);
});
