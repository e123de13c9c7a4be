import { describe, expect, it } from "vitest";
import { Flip } from "../../src/accuracy/measure/flip";
import { displayed, type ToneCurve, toneCurve } from "../../src/accuracy/measure/errors";
import { golden as read } from "../golden";

const golden = read("flip") as Record<"width" | "height", number> & Record<"truth" | "picture", number[]> & { flip: Record<string, number> };

/** Three values a pixel, with foam beside them. */
function pictureOf(rgb: readonly number[]) {
  const { width, height } = golden;
  const pixels = Float32Array.from({ length: 4 * width * height }, (_, i) => (i % 4 === 3 ? 1 : (rgb[3 * Math.floor(i / 4) + (i % 4)] ?? 0)));
  return { width, height, pixels };
}

describe("FLIP", () => {
  it.each([["none", null], ["filmic", "filmic"], ["photographic", "photographic"]] as [string, ToneCurve | null][])(
    "is what the server measures, tone curve %s",
    (name, curve) => {
      const flip = new Flip(displayed(pictureOf(golden.truth), curve), golden.width, golden.height);
      expect(flip.mean(displayed(pictureOf(golden.picture), curve))).toBeCloseTo(golden.flip[name] ?? NaN, 4);
      expect(flip.mean(displayed(pictureOf(golden.truth), curve))).toBe(0);
    },
  );

  it("has the scene's tone curve", () => {
    expect(toneCurve({ light: { tone: "photographic" } })).toBe("photographic");
    expect(toneCurve({ light: {} })).toBe("filmic");
    expect([toneCurve({ light: null }), toneCurve({})]).toEqual([null, null]);
  });
});
