import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it, vi } from "vitest";
import { Api } from "../../src/api";
import { linearAxis } from "../../src/charts/axis";
import { choiceText, coverage, decodeState, encodeState, follow, type LabState, load, maskPath, parseChoice, shades, START, threshold, viewOf } from "../../src/masklab/choice";
import { FORMATS, snippets, spreads } from "../../src/masklab/takehome";
import { nearestGrey, resample } from "../../src/masklab/spectra";

const LACE = { family: "lace", sigma: 8, width: 128, height: 128, seed: 7, aspect: 2, age: 0.5 } as const;

describe("a mask's text", () => {
  it.each(["vac-24", "vac:3:256:7", "vac:3:96x40:7", "lace:8:128:7:2:0.5", "blur:0.5:32:4294967295"])("%s is read and written", (text) => {
    const choice = parseChoice(text);
    expect(choice === null ? null : choiceText(choice)).toBe(text);
  });

  it.each(["", "vac:3:256", "vac:3:256:7:1:0", "vac:99:256:7", "vac:3:31:7", "vac:3:64x1025:7", "vac:3:64x:7", "vac:3:64:-1", "vac:3:64:1.5", "vac:x:64:1", "nope:3:64:1", "lace:8:128:7:9:0", "../etc"])(
    "%s is none",
    (text) => expect(parseChoice(text)).toBeNull(),
  );

  it("has its paths in the API", () => {
    expect(maskPath("vac-24")).toBe("api/masks/vac-24");
    expect(maskPath("vac-24", "data.u16")).toBe("api/masks/vac-24/data.u16");
    expect(maskPath(LACE, "spectrum")).toBe("api/masks/custom/spectrum?family=lace&sigma=8&width=128&height=128&seed=7&aspect=2&age=0.5");
    expect(maskPath({ ...LACE, family: "vac" })).toBe("api/masks/custom?family=vac&sigma=8&width=128&height=128&seed=7");
  });
});

describe("a mask that takes longer than a request may", () => {
  const info = { name: "vac", parameters: { width: 128, height: 128 } };
  const refused = () => Response.json({ title: "Invalid", errors: [{ detail: "sigma: takes about 590 s" }] }, { status: 422 });
  const events = (...parts: string[]) => {
    const start = (stream: ReadableStreamDefaultController) => {
      for (const part of parts) stream.enqueue(new TextEncoder().encode(part));
      stream.close();
    };
    return new Response(new ReadableStream({ start }));
  };
  const made = [events("event: progress\ndata: 0.2", "50\n\nevent: pro", 'gress\ndata: 0.750\n\nevent: done\ndata: {"name": "vac"}\n\n'), Response.json(info), new Response(new Uint16Array([7]).buffer), Response.json({})];

  it("is followed until it is there", async () => {
    const fetched = vi.spyOn(globalThis, "fetch");
    for (const answer of [refused(), ...made]) fetched.mockResolvedValueOnce(answer);
    const told = vi.fn();
    const loaded = await load(new Api("http://here/"), { ...LACE, family: "vac" }, new AbortController().signal, told);
    expect(told.mock.calls).toEqual([[0.25], [0.75]]);
    expect(loaded.mask.values).toEqual(new Uint16Array([7]));
    expect(fetched.mock.calls[1]?.[0]).toBe(`http://here/${maskPath({ ...LACE, family: "vac" }, "events")}`);
    fetched.mockRestore();
  });

  it("is none where it is refused there too, or is a shipped one", async () => {
    const fetched = vi.spyOn(globalThis, "fetch").mockImplementation(() => Promise.resolve(refused()));
    for (const choice of [LACE, "vac-24"]) await expect(load(new Api("http://here/"), choice, new AbortController().signal, vi.fn())).rejects.toThrow("Invalid");
    expect(fetched).toHaveBeenCalledTimes(3);
    fetched.mockRestore();
  });

  it("is not waited for once its events end", async () => {
    await expect(follow(events("event: progress\ndata: 0.1\n\n"), vi.fn())).rejects.toThrow("stopped making");
  });
});

describe("the laboratory's address", () => {
  it.each<LabState>([START, { left: LACE, right: "clump", grey: null, show: "detail" }, { left: "mix", right: null, grey: 0, show: "tiled" }])("restores %j", (state) => {
    expect(decodeState(`#${encodeState(state)}`)).toEqual(state);
  });

  it("survives nonsense", () => {
    expect(decodeState("#mask=!!&grey=7&show=x")).toEqual(START);
    expect(decodeState("")).toEqual(START);
    expect(decodeState("#beside=%%%").right).toBeNull();
  });
});

/** Ranks 0 to 15 in order. */
const mask = { width: 4, height: 4, values: Uint16Array.from({ length: 16 }, (_, rank) => Math.floor((rank * 65536) / 16)) };

describe("a pattern", () => {
  it.each([[0, 0], [0.25, 0.25], [0.5, 0.5], [1, 1]])("of grey %d has foam on %d", (grey, share) => {
    expect(coverage(threshold(mask, grey))).toBe(share);
  });

  it("shows where the mask is below it", () => expect([...threshold(mask, 0.19)]).toEqual([1, 1, 1, 1, ...Array<number>(12).fill(0)]));

  it("repeats", () => {
    const tiled = shades(mask, 0.25, "tiled");
    expect(tiled).toHaveLength(64);
    expect([...tiled.slice(0, 8)]).toEqual([...Array<number>(8).fill(255)]);
    expect([...tiled.slice(8, 16)]).toEqual([...Array<number>(8).fill(0)]);
    expect([...tiled.slice(32, 40)]).toEqual([...tiled.slice(0, 8)]);
  });

  it("is enlarged around the corner of the tiles", () => {
    expect(viewOf(512, "detail")).toEqual({ shown: 64, first: 480 });
    expect(viewOf(4, "detail")).toEqual({ shown: 4, first: 2 });
    // Rows 2, 3, 0, 1: the foam of row 0 is in the third.
    expect([...shades(mask, 0.25, "detail")].map((shade) => shade / 255)).toEqual([0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0]);
  });

  it("of an oblong mask is as oblong", () => {
    const oblong = { width: 8, height: 2, values: mask.values };
    expect([...shades(oblong, 0.25, "tiled").slice(0, 16)].map((shade) => shade / 255)).toEqual([1, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0]);
    expect(shades(oblong, 0.25, "tiled")).toHaveLength(64);
  });

  it("is the mask itself without a grey", () => expect([...shades(mask, null, "tile").slice(0, 3)]).toEqual([0, 16, 32]));
});

describe("spectra", () => {
  it("are of the nearest grey", () => {
    const greys = [1 / 16, 1 / 8, 1 / 4, 1 / 2, 3 / 4].map((grey) => ({ grey }));
    expect([0, 0.2, 0.4, 1].map((grey) => nearestGrey(greys, grey))).toEqual([0, 2, 3, 4]);
  });

  it("of two sizes share their frequencies", () => {
    expect(resample([0.125, 0.25, 0.375], [1, 3, null], [0.125, 0.1875, 0.25, 0.3125, 0.5])).toEqual([1, 2, 3, null, null]);
    expect(resample([0.1, 0.2], [1, 3], [0.05])).toEqual([null]);
  });

  it("have a linear axis for decibels", () => {
    const axis = linearAxis([-4, 0, 8]);
    expect(axis.position(2)).toBeCloseTo(0.5, 6);
    expect(axis.ticks).toEqual([-4, -2, 0, 2, 4, 6, 8]);
    expect(linearAxis([]).ticks.length).toBeGreaterThan(1);
    expect(linearAxis([3, 3]).position(3)).toBeCloseTo(0.5, 6);
  });
});

describe("snippets", () => {
  const folder = join(import.meta.dirname, "../../../docs/snippets");
  const bytes = readFileSync(join(folder, "mask.u16"));
  const own = { width: 256, height: 256, values: new Uint16Array(bytes.buffer, bytes.byteOffset, bytes.length / 2) };

  it("are the files of docs/snippets, for the mask there", () => {
    const files = ["three.js", "godot.gdshader", "unity.hlsl", "unreal.usf", "shadertoy.glsl", "foam.glsl"];
    expect(snippets("mask.u16", own).map(({ code }) => code)).toEqual(files.map((file) => readFileSync(join(folder, file), "utf8")));
    for (const file of files) expect(readFileSync(join(folder, file), "utf8").trimEnd().split("\n").length).toBeLessThanOrEqual(40);
  });

  it("have the numbers of another mask", () => {
    const oblong = { width: 8, height: 2, values: mask.values };
    expect(spreads(mask).map((value) => Math.round(1000 * value) / 1000)).toEqual([0, 0.223, 0.499, ...Array<number>(8).fill(0.499)]);
    for (const { name, code } of snippets('http://host/a"b/data.u16', oblong)) {
      if (name === "three.js") expect(code).toContain('url = "http://host/a\\"b/data.u16", width = 8, height = 2');
      if (name === "Godot" || name === "Unity") expect(code).toContain("(8, 2, ");
      if (name !== "Shadertoy") expect(code).toContain("0.0, 0.436, 0.45, 0.499, ");
    }
  });

  it("say what was run, and download what they read", () => {
    const files = FORMATS.map(({ resource }) => resource as string);
    for (const { file, tested, note } of snippets("x", own)) {
      expect(note.includes("not run here")).toBe(!tested);
      if (file !== null) expect(files).toContain(file);
    }
  });
});
