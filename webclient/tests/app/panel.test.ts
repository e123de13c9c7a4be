import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { choiceControls, type Control, controlOf, schemaNamed, switchedOn } from "../../src/panel/model";
import { fromDisplayed, toDisplayed } from "../../src/panel/pane";
import { isObject, type Json, type JsonObject, withValue } from "../../src/scene/json";

/** A schema with every shape that pydantic writes, about nothing that a scene holds. */
const root: JsonObject = {
  components: {
    schemas: {
      Thing: {
        type: "object",
        description: "A thing.",
        properties: {
          share: { type: "number", minimum: 0, maximum: 1, default: 0.5, description: "How much" },
          wide: { type: "number", minimum: 0.05, maximum: 2000, default: 3 },
          turn: { type: "number", minimum: -6.2832, maximum: 6.2832, default: 0, unit: "rad" },
          count: { type: "integer", minimum: 0, maximum: 9, default: 1 },
          kind: { type: "string", enum: ["one_way", "two_way"], default: "one_way" },
          name: { type: "string", default: "x", choices_from: "/api/names" },
          on: { type: "boolean", default: true },
          tint: { type: "array", prefixItems: [0, 1, 2].map(() => ({ type: "number", minimum: 0, maximum: 1 })), default: [0, 0, 0] },
          spans: { type: "array", prefixItems: [0, 1, 2].map(() => ({ type: "number", minimum: 0.01, maximum: 1000 })), default: [1, 2, 3] },
          depth: { anyOf: [{ type: "number", minimum: 1, maximum: 10 }, { type: "null" }], default: null, description: "How deep" },
          drift: {
            anyOf: [{ type: "number", minimum: 0, maximum: 5 }, { type: "null" }],
            default: null,
            follows: { field: "/wind/speed", factor: 0.5, calm: 4, alone: 3 },
          },
          part: { anyOf: [{ $ref: "#/components/schemas/Part" }, { type: "null" }], default: null },
          always: { $ref: "#/components/schemas/Part" },
          list: {
            type: "array",
            maxItems: 2,
            default: [],
            items: {
              discriminator: { propertyName: "model" },
              oneOf: [{ $ref: "#/components/schemas/A" }, { $ref: "#/components/schemas/B" }],
            },
          },
          extensions: { $ref: "#/components/schemas/Extensions", default: {} },
          lone: { type: "array", minItems: 1, default: [], items: { $ref: "#/components/schemas/A" } },
        },
      },
      Extensions: {
        type: "object",
        additionalProperties: false,
        properties: {
          rows: { anyOf: [{ type: "object", properties: { spacing: { type: "number", minimum: 1, maximum: 500, default: 14 } } }, { type: "null" }] },
        },
      },
      Part: { type: "object", properties: { size: { type: "number", minimum: 0, maximum: 4, default: 2 } } },
      A: { type: "object", properties: { model: { const: "a", type: "string", default: "a" }, x: { type: "number", default: 1 } } },
      B: { type: "object", properties: { model: { const: "b", type: "string", default: "b" }, y: { type: "number", default: 2 } } },
    },
  },
};

const thing: JsonObject = {
  share: 0.2, wide: 3, turn: 0, count: 1, kind: "one_way", name: "x", on: true, tint: [0, 0, 0], spans: [1, 2, 3],
  depth: null, part: null, always: { size: 1 }, list: [{ model: "b", y: 3 }], lone: [{ model: "a", x: 1 }],
}; // prettier-ignore

function model(value: Json = thing): Map<string, Control> {
  const schema = schemaNamed(root, "Thing");
  const control = schema && controlOf(root, schema, value, "", "thing");
  if (control?.kind !== "group") throw new Error("no group");
  return new Map(control.children.map((child) => [child.label, child]));
}

describe("a schema becomes a panel", () => {
  it("with a switch for a part of an effect outside the package, which the scene need not have", () => {
    const group = model().get("extensions");
    if (group?.kind !== "group") throw new Error("no group");
    const [rows] = group.children;
    expect(rows).toMatchObject({ kind: "optional", pointer: "/extensions/rows", inner: null, initial: { spacing: 14 } });
    const on = withValue(thing, "/extensions/rows", { spacing: 14 });
    expect(on).toMatchObject({ share: 0.2, extensions: { rows: { spacing: 14 } } });
  });
  it("with a slider for a bounded number", () => {
    expect(model().get("share")).toMatchObject({ kind: "number", min: 0, max: 1, hint: "How much", logarithmic: false, angle: false });
    expect(model().get("count")).toMatchObject({ kind: "number", step: 1 });
  });

  it("logarithmic over more than three decades", () => {
    expect(model().get("wide")).toMatchObject({ logarithmic: true, pointer: "/wide" });
  });

  it("with degrees for radians", () => {
    const turn = model().get("turn");
    if (turn?.kind !== "number") throw new Error("no number");
    expect(turn.angle).toBe(true);
    expect(toDisplayed(turn, Math.PI)).toBe(180);
    expect(fromDisplayed(turn, 90)).toBeCloseTo(Math.PI / 2, 5);
    expect(fromDisplayed(turn, 400)).toBe(6.2832);
  });

  it("with lists for enumerations and for names that the server lists", () => {
    expect(model().get("kind")).toMatchObject({ kind: "choice", options: ["one_way", "two_way"] });
    expect(model().get("name")).toMatchObject({ kind: "name", url: "/api/names" });
    const group = { kind: "group", pointer: "", label: "", hint: "", children: [...model().values()] } as const;
    expect(choiceControls(group).map(({ pointer }) => pointer)).toEqual(["/kind", "/name"]);
  });

  it("with colours for shares of three, and plain numbers for other tuples", () => {
    expect(model().get("tint")?.kind).toBe("colour");
    expect(model().get("spans")).toMatchObject({ kind: "group", children: [{ pointer: "/spans/0" }, {}, {}] });
  });

  it("with a switch for what may be null", () => {
    expect(model().get("depth")).toMatchObject({ kind: "optional", inner: null, initial: 5.5, hint: "How deep" });
    expect(model({ ...thing, depth: 2 }).get("depth")).toMatchObject({ inner: { kind: "number", max: 10 } });
    expect(model().get("part")).toMatchObject({ kind: "optional", inner: null, initial: { size: 2 } });
    expect(model().get("always")).toMatchObject({ kind: "group", children: [{ pointer: "/always/size" }] });
  });

  it("with a switch that begins where a field that follows the wind is", () => {
    const drift = model().get("drift");
    if (drift?.kind !== "optional") throw new Error("no switch");
    expect([8, 2, 30].map((speed) => switchedOn(drift, { wind: { speed } }))).toEqual([2, 0, 5]);
    expect(switchedOn(drift, { wind: null })).toBe(3);
  });

  it("with a folder for each of a list, by its kind", () => {
    const list = model().get("list");
    if (list?.kind !== "list") throw new Error("no list");
    expect(list.discriminator).toBe("model");
    expect(list.variants.map(({ name, initial }) => [name, initial])).toEqual([
      ["a", { model: "a", x: 1 }],
      ["b", { model: "b", y: 2 }],
    ]);
    expect(list.items).toMatchObject([{ variant: "b", control: { kind: "group", children: [{ pointer: "/list/0/y" }] } }]);
    expect(list).toMatchObject({ minItems: 0, maxItems: 2 });
  });

  it("even where a list holds one kind alone", () => {
    expect(model().get("lone")).toMatchObject({ kind: "list", minItems: 1, variants: [{ name: "a" }], items: [{ variant: "a" }] });
  });
});

describe("the server's own schema", () => {
  const document = JSON.parse(readFileSync(new URL("../../openapi.json", import.meta.url), "utf8")) as JsonObject;

  it("becomes controls, every field of it", () => {
    const schema = schemaNamed(document, "Scene");
    const control = schema && controlOf(document, schema, {}, "", "scene");
    if (!schema || control?.kind !== "group" || !isObject(schema["properties"] ?? null)) throw new Error("no scene");
    expect(control.children.map(({ pointer }) => pointer.slice(1))).toEqual(Object.keys(schema["properties"] as JsonObject));
  });
});
