import { deflateSync } from "node:zlib";
import { execFileSync } from "node:child_process";
import { describe, expect, test } from "vitest";
import { decode, encode } from "../../src/selection/url";
import { crc32, curl, exactFrame, javascript, linkOf, python, readRecipe, type Recipe, RecipeError, recipeOf, requestOf, withRecipe } from "../../src/take/recipe";

const SCENE = { waves: [{ model: "parametric", steepness: 0.1 + 0.2 }], foam: { mask: "vac-6" }, camera: { position: [0, 6, 0], yaw: 0, pitch: -0.15, roll: 0, fov: 0.8727 } };
const CAMERA = { position: [1.5, 2.25, -1e6], yaw: 0.1, pitch: -0.3, roll: 0, fov: 0.9 } as const;
const RECIPE: Recipe = recipeOf({
  ...{ renderer: "any “renderer”", preset: "default", scene: { ...SCENE, foam: { mask: "blur-3" } }, quality: "high" },
  ...{ camera: CAMERA, time: 4.1234567890123, width: 320, height: 180, split: null },
});

const chunk = (type: string, data: Uint8Array) => {
  const bytes = new Uint8Array(12 + data.length);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, data.length);
  bytes.set(new TextEncoder().encode(type), 4);
  bytes.set(data, 8);
  view.setUint32(8 + data.length, crc32(bytes.subarray(4, 8 + data.length)));
  return bytes;
};

/** One black pixel. */
const PNG = new Blob([
  new Uint8Array([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
  chunk("IHDR", new Uint8Array([0, 0, 0, 1, 0, 0, 0, 1, 8, 2, 0, 0, 0])),
  chunk("IDAT", new Uint8Array(deflateSync(new Uint8Array([0, 0, 0, 0])))),
  chunk("IEND", new Uint8Array()),
]);

/** Header of an OpenEXR file: the compression, then these attributes. */
const exr = (...attributes: [string, string, string][]) => {
  const all: [string, string, string][] = [["compression", "compression", "\x03"], ...attributes];
  const parts = all.flatMap(([name, type, value]) => {
    const data = new TextEncoder().encode(value);
    return [`${name}\0${type}\0`, new Uint32Array([data.length]), data];
  });
  return new Blob(["v/1\x01\x02\0\0\0", ...parts, "\0"]);
};

const withText = async (recipe: unknown) => withRecipe(PNG, recipe as Recipe);

describe("recipe in a PNG", () => {
  test("crc32 of the standard's check value", () => {
    expect(crc32(new TextEncoder().encode("123456789"))).toBe(0xcbf43926);
  });

  test("comes back as it was written", async () => {
    expect(await readRecipe(await withRecipe(PNG, RECIPE))).toEqual(RECIPE);
  });

  test.each([
    ["none", PNG, 1],
    ["some", new Blob([PNG.slice(0, 33), chunk("sRGB", new Uint8Array(1)), PNG.slice(33)]), 1],
    ["a profile", new Blob([PNG.slice(0, 33), chunk("iCCP", new Uint8Array(9)), PNG.slice(33)]), 0],
  ])("is tagged as sRGB where it says %s of its colours", async (_, file, count) => {
    const text = new TextDecoder("latin1").decode(await (await withRecipe(file, RECIPE)).arrayBuffer());
    expect(text.split("sRGB")).toHaveLength(count + 1);
    expect(text.indexOf("sRGB")).toBeLessThan(text.indexOf("IDAT"));
  });

  test.each([
    ["a text", new Blob(["not a picture"]), "not a PNG, WebP or OpenEXR"],
    ["a picture without", PNG, "no recipe"],
    ["a picture that is cut off", PNG.slice(0, 40), "no recipe"],
  ])("%s is refused with the reason", async (_, file, said) => {
    await expect(readRecipe(file)).rejects.toThrow(said);
    await expect(readRecipe(file)).rejects.toBeInstanceOf(RecipeError);
  });

  test.each([{ recipe: 2 }, { time: "soon" }, { time: 1e12 }, { camera: { position: [0, 1] } }, { quality: null }, { scene: [] }])("%j is refused", async (change) => {
    await expect(readRecipe(await withText({ ...RECIPE, ...change }))).rejects.toBeInstanceOf(RecipeError);
  });

  test("comes from the header of an OpenEXR file", async () => {
    expect(await readRecipe(exr(["seafoam", "string", JSON.stringify(RECIPE)]))).toEqual(RECIPE);
  });

  test.each([
    ["without the attribute", exr()],
    ["with an attribute of another type", exr(["seafoam", "stringvector", "{}"])],
    ["cut off in its header", exr(["seafoam", "string", "{}"]).slice(0, 30)],
  ])("an OpenEXR file %s is refused", async (_, file) => {
    await expect(readRecipe(file)).rejects.toThrow("no recipe");
  });

  test("a split that is not one is left out", async () => {
    expect((await readRecipe(await withText({ ...RECIPE, split: { field: 3 } }))).split).toBeNull();
  });
});

describe("link of a recipe", () => {
  test("has the changes to the preset, and survives the address", () => {
    const link = linkOf(RECIPE, { name: "default", scene: SCENE });
    expect(link.changes).toEqual([["/foam/mask", "blur-3"]]);
    expect(link.camera).toEqual(CAMERA);
    expect(link.paused).toBe(true);
    expect(decode(encode(link))).toEqual(link);
  });

  test("does not take the camera for a change of the scene", () => {
    const moved = { ...RECIPE, scene: { ...SCENE, camera: { ...SCENE.camera, yaw: 1 } } };
    expect(linkOf(moved, { name: "default", scene: SCENE }).changes).toEqual([]);
  });
});

describe("requests of a frame", () => {
  const server = "http://127.0.0.1:8000/";

  test("a preset as it is by a query", () => {
    const { url, body } = requestOf({ ...RECIPE, scene: SCENE }, { name: "default", scene: SCENE }, server);
    expect(body).toBeNull();
    const query = new URL(url).searchParams;
    expect(["time", "quality", "z", "dither"].map((name) => query.get(name))).toEqual(["4.1234567890123", "high", "-1000000", "false"]);
  });

  test("a changed scene, and settings of a quality, by a body", () => {
    for (const recipe of [RECIPE, { ...RECIPE, scene: SCENE, quality: { samples: 4 } }]) {
      const { url, body } = requestOf(recipe, { name: "default", scene: SCENE }, server);
      expect(url).toBe(`${server}api/frames`);
      expect(JSON.parse(body ?? "")).toEqual(exactFrame(recipe));
    }
  });

  test("quotes survive every language", () => {
    const request = { url: "http://x/", body: `{"name":"it's \\"quoted\\" “so”"}` };
    const shell = curl(request).replace(/^curl.*--data-binary /, "printf %s ");
    expect(execFileSync("sh", ["-c", shell]).toString()).toBe(request.body);
    const line = python(request).split("\n").find((each) => each.startsWith("body")) ?? "";
    const printed = execFileSync(process.env["PYTHON"] ?? "python3", ["-c", `import sys\n${line}\nsys.stdout.buffer.write(body.encode())`]).toString();
    expect(printed).toBe(request.body);
    expect(javascript(request)).toContain(JSON.stringify(request.body));
  });
});
