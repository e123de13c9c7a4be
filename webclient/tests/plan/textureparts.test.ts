import { describe, expect, it } from "vitest";
import type { FramePlan, Texture } from "../../src/generated/api";
import { decoded, joined, roughTextures, TextureParts } from "../../src/plan/textureparts";
import { golden as read } from "../golden";

const golden = read("texture_parts") as { width: number } & Record<"texels" | "upper" | "lower", number[]>;
const spec: Texture = { url: "/ranks", sha256: "hash", format: "R16UI", width: golden.width, height: 4, levels: 1, filter: "nearest", wrap: "repeat" };

/** A server of the golden texture, and what it was asked for. */
function served() {
  const asked: string[] = [];
  let refused = 0;
  const parts = new TextureParts((_, part) => {
    asked.push(part ?? "whole");
    if (part === undefined) return Promise.resolve(Uint16Array.from(golden.texels).buffer);
    return refused-- > 0 ? Promise.reject(new Error("away")) : Promise.resolve(Uint8Array.from(golden[part]).buffer);
  });
  const rough = () => {
    const textures = parts.roughOf({ textures: { ranks: spec }, passes: [] });
    if (textures === null) throw new Error("The plan has no rough textures.");
    return textures.bytes(spec);
  };
  return { asked, parts, rough, refuse: (times: number) => (refused = times) };
}

describe("the parts of a texture", () => {
  it("are those that the server makes", () => {
    const upper = decoded(Uint8Array.from(golden.upper), golden.width);
    expect([...upper]).toEqual(golden.texels.map((texel) => texel >> 10));
    expect([...joined(upper, Uint8Array.from(golden.lower))]).toEqual(golden.texels);
  });

  it("are asked for once each", async () => {
    const { asked, parts, rough } = served();
    const texels = [...new Uint16Array(await rough())];
    expect(texels.map((texel, i) => Math.abs(texel - (golden.texels[i] ?? NaN)) <= 512)).not.toContain(false);
    await rough();
    expect([...new Uint16Array(await parts.exact(spec))]).toEqual(golden.texels);
    expect(asked).toEqual(["upper", "lower"]);
    // What is joined is not kept here: the GPU has it.
    await parts.exact(spec);
    expect(asked).toEqual(["upper", "lower", "whole"]);
  });

  it("are not asked for where all of it is wanted at once", async () => {
    const { asked, parts } = served();
    await parts.exact(spec);
    expect(asked).toEqual(["whole"]);
  });

  it("may fail to come, and are asked for again", async () => {
    const { asked, parts, rough, refuse } = served();
    refuse(1);
    await expect(rough()).rejects.toThrow("away");
    await rough();
    refuse(1);
    await expect(parts.exact(spec)).rejects.toThrow("away");
    expect([...new Uint16Array(await parts.exact(spec))]).toEqual(golden.texels);
    expect(asked).toEqual(["upper", "upper", "lower", "lower"]);
  });
});

describe("rough textures", () => {
  const pass = (when: "setup" | "frame", texture: string) => ({ when, inputs: { t: { texture } } }) as unknown as FramePlan["passes"][number];
  const textures = { table: spec, seen: spec, both: spec, colours: { ...spec, format: "R8" } } as const;

  it("are those of 16 bits that only setup passes read", () => {
    const passes = [pass("setup", "table"), pass("frame", "seen"), pass("setup", "both"), pass("frame", "both"), pass("setup", "colours")];
    expect([...roughTextures({ textures, passes })]).toEqual(["table"]);
  });

  it("are none in a plan that needs all digits", () => {
    expect(served().parts.roughOf({ textures: { seen: spec }, passes: [pass("frame", "seen")] })).toBeNull();
  });
});
