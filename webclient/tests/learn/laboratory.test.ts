import { describe, expect, it } from "vitest";
import { linkedSources, sourcePage } from "../../build/sources";
import { formatState, MASKS, NUMBERS, parseState, RANGES } from "../../src/learn/laboratory/state";

describe("the laboratory's address", () => {
  it("is empty at the start", () => {
    expect(formatState(parseState(""))).toBe("");
  });

  it("holds every control", () => {
    const state = parseState("");
    for (const name of NUMBERS) state.numbers[name].value = (RANGES[name].min + RANGES[name].max) / 2;
    state.mask.value = "vac-1.5";
    state.other.value = "mix";
    const link = formatState({ ...state, paused: true, time: 12.5 });
    const back = parseState(link);
    for (const name of NUMBERS) expect(back.numbers[name].value).toBe(state.numbers[name].value);
    expect([back.mask.value, back.other.value, back.paused, back.time]).toEqual(["vac-1.5", "mix", true, 12.5]);
    expect(formatState(back)).toBe(link);
  });

  it.each(["c=1e9", "c=-1", "c=", "c=x", "c=NaN", "mask=../secret", "mask=", "time=-5", "paused=yes"])("starts anew for %s", (part) => {
    const state = parseState(`#${part}`);
    expect(state.numbers.c.value).toBe(RANGES.c.start);
    expect(state.mask.value).toBe(MASKS.mask);
    expect(formatState(state)).toBe("");
  });
});

describe("source pages", () => {
  const glsl = "// A look.\nfloat foam_amount(float f) {\n    return f < 1.0 ? f : 1.0;\n}\n";

  it("are those that pages link to", () => {
    const found = linkedSources(['<a href="../source/a/b.glsl.html#foam_amount">', '<a href="../source/a/b.glsl.html">']);
    expect([...found]).toEqual([["a/b.glsl", new Set(["foam_amount"])]]);
  });

  it("name the lines of definitions, and escape the rest", () => {
    const page = sourcePage("a/b.glsl", glsl, new Set(["foam_amount"]));
    expect(page).toContain('<li id="foam_amount"><code>float foam_amount(float f) {</code></li>');
    expect(page).toContain("return f &lt; 1.0 ? f : 1.0;");
    expect(page).toContain('href="../../source.css"');
  });

  it("name headings and terms of a text without their numbers", () => {
    const page = sourcePage("docs/f.md", "## 4. Saturation f, in [0, 4]\n\n**Front** (Yingst et al. 2011): f\n", new Set());
    expect(page).toContain('<li id="saturation-f-in-0-4">');
    expect(page).toContain('<li id="front">');
  });

  it("refuse a link to a symbol that is gone", () => {
    expect(() => sourcePage("a/b.glsl", glsl, new Set(["foam_share"]))).toThrow("a/b.glsl has no foam_share");
  });
});
