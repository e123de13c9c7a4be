/** Finding presets, their addresses, and the keys of the gallery. */
import { expect, test } from "vitest";
import type { PresetSummary } from "../../src/api";
import { linkOf } from "../../src/app/address";
import { grouped, indexAfter, matching, presetOfPath } from "../../src/gallery/gallery";
import { frameAfter } from "../../src/app/transport";

const preset = (name: string, group: string, title: string, summary: string, effects: string[] = []): PresetSummary => ({ name, group, title, summary, effects, size: [16, 9] });
const PRESETS = [
  preset("storm", "Seas", "Storm at sea", "Foam in streaks", ["whitecaps"]),
  preset("swell", "Seas", "Évening swell", "Long waves", ["living_foam"]),
  preset("beach", "Shores", "Beach", "Foam on sand"),
];
const names = (query: string) => matching(PRESETS, query).map(({ name }) => name);

test("a search finds every word, in any order, in title, summary, group, name and effects", () => {
  expect(names("")).toEqual(["storm", "swell", "beach"]);
  expect(names("foam")).toEqual(["storm", "swell", "beach"]);
  expect(names("SAND foam")).toEqual(["beach"]);
  expect(names("evening")).toEqual(["swell"]);
  expect(names("living foam")).toEqual(["swell"]);
  expect(names("seas")).toEqual(["storm", "swell"]);
  expect(names("caustics")).toEqual([]);
});

test("groups keep the order of the list", () => {
  expect(grouped(PRESETS).map(({ heading, presets }) => [heading, presets.length])).toEqual([["Seas", 2], ["Shores", 1]]);
});

test("keys move within a list and stop at its ends", () => {
  const moves = [["ArrowRight", 0], ["ArrowDown", -1], ["ArrowUp", 0], ["ArrowRight", 2], ["Home", 2], ["End", 0], ["Enter", 0]] as const;
  expect(moves.map(([key, from]) => indexAfter(key, from, 3))).toEqual([1, 0, 0, 2, 0, 2, null]);
  expect(indexAfter("End", 0, 0)).toBeNull();
});

test("an address names its preset in the path, and an old one in the fragment", () => {
  expect(presetOfPath("/water/lake-calm")).toBe("lake-calm");
  expect(presetOfPath("/deep/below/water/storm")).toBe("storm");
  expect(presetOfPath("/")).toBeNull();
  expect(presetOfPath("/water/")).toBeNull();
  expect(linkOf({ pathname: "/water/storm", hash: "#time=3", search: "" })).toMatchObject({ preset: "storm", time: 3 });
  expect(linkOf({ pathname: "/", hash: "#preset=beach", search: "" }).preset).toBe("beach");
  expect(linkOf({ pathname: "/water/storm", hash: "#preset=beach", search: "" }).preset).toBe("beach");
  expect(linkOf({ pathname: "/", hash: "", search: "" }).preset).toBeNull();
});

test("a step goes from frame to frame of 1/60 s without drift", () => {
  let time = 0;
  for (let i = 1; i <= 600; i++) {
    time = frameAfter(time, 1);
    expect(time).toBe(i / 60);
  }
  expect(frameAfter(time, -1)).toBe(599 / 60);
  // From between two frames, to the nearer one in that direction.
  expect(frameAfter(0.02, 1)).toBe(2 / 60);
  expect(frameAfter(0.02, -1)).toBe(1 / 60);
  expect(frameAfter(0, -1)).toBe(-1 / 60);
});
