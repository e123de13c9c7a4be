import { readdirSync, readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, test } from "vitest";
import type { FramePlan, Pass } from "../../src/generated/api";
import { changesBetween } from "../../src/planview/surface";
import { graphOf, targetText } from "../../src/planview/passes";
import { lines, tokens } from "../../src/planview/source";

const SHADERS = join(import.meta.dirname, "../../../shaders");
const sources = (readdirSync(SHADERS, { recursive: true }) as string[])
  .map((name) => join(SHADERS, name))
  .filter((path) => path.endsWith(".glsl") && statSync(path).isFile())
  .map((path) => readFileSync(path, "utf8"));

describe("highlighting", () => {
  test("loses no character of any shader", () => {
    expect(sources.length).toBeGreaterThan(50);
    for (const source of sources) {
      expect(tokens(source).map(({ text }) => text).join("")).toBe(source);
      const rows = lines(source);
      expect(rows.flat().map(({ text }) => text).join("")).toBe(source);
      expect(rows.length).toBe(source.split("\n").length - (source.endsWith("\n") ? 1 : 0));
    }
  });

  test("tells what is what", () => {
    const kinds = Object.fromEntries(tokens("#version 300 es\nuniform vec2 u_x; // 1.0\nfloat y2 = 1.5e-3 + 0x1Fu;").map(({ kind, text }) => [text, kind]));
    expect(kinds).toMatchObject({ "#version 300 es": "directive", uniform: "keyword", vec2: "type", "// 1.0": "comment", float: "type", "1.5e-3": "number", "0x1Fu": "number" });
    expect(Object.keys(kinds)).not.toContain("2");
  });
});

const pass = (program: string, target: string, reads: string[] = [], when: Pass["when"] = "frame") =>
  ({ name: program, program, target, when, inputs: Object.fromEntries(reads.map((name) => [name, { target: name }])) }) as unknown as Pass;

describe("graph", () => {
  const passes = [pass("still", "map", [], "setup"), pass("a", "x"), pass("b", "y", ["x", "map"]), pass("a", "x", ["y"]), pass("c", "screen", ["x", "y"])];

  test("passes of a program are one node, to the right of what it reads", () => {
    const { nodes, columns, rows } = graphOf({ passes }, "frame");
    expect(nodes.map(({ program, column }) => [program, column])).toEqual([["a", 0], ["b", 1], ["c", 2]]);
    expect(nodes[0]?.passes).toEqual([1, 3]);
    expect([...(nodes[2]?.reads ?? [])].map(({ program }) => program)).toEqual(["a", "b"]);
    expect([columns, rows]).toEqual([3, 1]);
  });

  test("what is drawn once is apart", () => {
    expect(graphOf({ passes }, "setup").nodes.map(({ program }) => program)).toEqual(["still"]);
  });

  test("no two nodes share a place", () => {
    const { nodes } = graphOf({ passes: [pass("a", "x"), pass("b", "y"), pass("c", "z"), pass("d", "screen", ["x", "y", "z"])] }, "frame");
    expect(new Set(nodes.map(({ column, row }) => `${column} ${row}`)).size).toBe(nodes.length);
  });

  test("sizes follow the picture", () => {
    const targets = { half: { size: { rule: "viewport", scale: 1, part: 2, narrow: 1, odd: false }, format: "RGBA16F", depth: true, filter: "nearest", wrap: "repeat", layers: 3 } } as const;
    expect(targetText({ targets }, "half", 321, 181)).toEqual({ size: "161 × 91 × 3", format: "RGBA16F, depth" });
    expect(targetText({ targets }, "screen", 321, 181)).toEqual({ size: "321 × 181", format: "RGBA8" });
  });
});

describe("changes", () => {
  const shader = (sha256: string) => ({ text: "", sha256, files: [] });
  const plan = (change: Partial<FramePlan>): FramePlan => ({ effects: [], skipped: [], passes: [], programs: {}, targets: {}, textures: {}, uniforms: {}, samples: 1, ...change }) as unknown as FramePlan;

  test("equal plans have none", () => expect(changesBetween(plan({}), plan({}))).toEqual([]));

  test("each difference is named once", () => {
    const uniform = (value: number) => ({ type: "float" as const, count: 1, rules: [{ rule: "constant" as const, value: [value], field: null }] });
    const before = plan({ programs: { surface: { vertex: shader("1"), fragment: shader("2") } }, uniforms: { u_a: uniform(1), u_b: uniform(5) }, effects: [{ name: "clouds", why: "2 layers", files: [] }] as never });
    const after = plan({ programs: { surface: { vertex: shader("1"), fragment: shader("3") } }, uniforms: { u_a: uniform(2), u_b: uniform(5) }, skipped: [{ name: "clouds", why: "no cover", files: [] }] as never, samples: 4 });
    expect(changesBetween(before, after).map(({ what, name, how, detail }) => [what, name, how, detail])).toEqual([
      ["effect", "clouds", "removed", "2 layers"],
      ["skipped effect", "clouds", "added", "no cover"],
      ["program", "surface", "changed", "GLSL"],
      ["uniform", "u_a", "changed", "1 → 2"],
      ["samples per pixel", "samples", "changed", "1 → 4"],
    ]);
  });
});
