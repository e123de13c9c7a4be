/** Controls of a panel, derived from a JSON Schema. */
import type { Choice, SceneSchema } from "../api";
import { CAMERA_POINTER } from "../plan/rules";
import { child, equal, get, isObject, type Json, type JsonObject } from "../scene/json";

/** `hint`: the schema's description. */
interface LabelledField { pointer: string; label: string; hint: string; }

export interface NumberControl extends LabelledField {
  kind: "number";
  min: number | null;
  max: number | null;
  step: number | null;
  angle: boolean; // Radians in the scene, degrees in the panel
  logarithmic: boolean; // For ranges of several decades
}

interface ChoiceControl extends LabelledField { kind: "choice"; options: readonly string[]; }

/** A choice whose options the server lists at `url`. */
interface NameControl extends LabelledField { kind: "name"; url: string; }

/** A colour is red, green and blue in [0, 1]. */
interface SimpleControl extends LabelledField { kind: "toggle" | "text" | "colour"; }

export interface GroupControl extends LabelledField { kind: "group"; children: readonly Control[]; }

/** A nullable field: `inner` is its control while it is not null, `initial` its value when switched on, if it does not follow another. */
export interface OptionalControl extends LabelledField {
  kind: "optional";
  inner: Control | null;
  initial: Json;
  follows: JsonObject | null;
}

export interface ListControl extends LabelledField {
  kind: "list";
  items: readonly { control: Control; variant: string | null }[];
  /** Types of items. */
  variants: readonly { name: string; hint: string; initial: Json }[];
  discriminator: string | null;
  minItems: number;
  maxItems: number;
}

export type Control = NumberControl | ChoiceControl | NameControl | SimpleControl | GroupControl | OptionalControl | ListControl;

const DECADES = 3;
const RADIANS = "rad";

/** The control of a value; `null` if the schema has nothing to set. */
export function controlOf(root: JsonObject, schema: JsonObject, value: Json | undefined, pointer: string, name: string): Control | null {
  const inner = resolve(root, schema);
  const labelledField: LabelledField = {
    pointer,
    label: labelOf(name),
    hint: text(schema["description"]) ?? (schema["$ref"] ? "" : (text(inner["description"]) ?? "")),
  };
  const nullable = nullableMember(root, inner);
  if (nullable) {
    const extras = { ...nullable, ...(inner["unit"] === undefined ? {} : { unit: inner["unit"] }) };
    const present = value !== null && value !== undefined;
    const control = present ? controlOf(root, extras, value, pointer, name) : null;
    const follows = isObject(inner["follows"]) ? { min: bound(nullable, "minimum"), max: bound(nullable, "maximum"), ...inner["follows"] } : null;
    return { ...labelledField, kind: "optional", inner: control, initial: initialValue(root, nullable), follows };
  }
  if ("const" in inner) return null;
  const variants = variantsOf(root, inner);
  if (variants) {
    const key = discriminatorOf(root, inner) ?? "";
    const variant = variants.find(({ tag }) => tag !== null && isObject(value) && value[key] === tag) ?? variants[0];
    return variant ? controlOf(root, variant.schema, value, pointer, name) : null;
  }
  const options = inner["enum"];
  if (Array.isArray(options)) return choice(labelledField, options);
  switch (inner["type"]) {
    case "number":
    case "integer": return number(labelledField, inner);
    case "boolean": return { ...labelledField, kind: "toggle" };
    case "string": {
      const url = text(inner["choices_from"]);
      return url === undefined ? { ...labelledField, kind: "text" } : { ...labelledField, kind: "name", url };
    }
    case "array": return array(root, inner, value, labelledField);
    case "object": {
      const fields = isObject(value) ? value : {};
      const children = propertiesOf(inner).flatMap(([key, property]) => {
        const field = fields[key] ?? (key in fields ? null : initialValue(root, property));
        return controlOf(root, property, field, child(pointer, key), key) ?? [];
      });
      return { ...labelledField, kind: "group", children };
    }
    default: return null;
  }
}

function propertiesOf(schema: JsonObject): [string, JsonObject][] {
  const properties = isObject(schema["properties"]) ? schema["properties"] : {};
  return Object.entries(properties).filter((entry): entry is [string, JsonObject] => isObject(entry[1]));
}

/** The value of a nullable field when it is switched on: where it follows another, what it was while it was null. */
export function switchedOn({ follows, initial }: OptionalControl, scene: Json): Json {
  if (follows === null) return initial;
  const value = get(scene, text(follows["field"]) ?? "");
  if (typeof value !== "number") return follows["alone"] ?? initial;
  const own = Number(follows["factor"]) * (value - Number(follows["calm"]));
  return Math.min(Number(follows["max"] ?? Infinity), Math.max(Number(follows["min"] ?? -Infinity), own));
}

/** A field's default, or the defaults of its fields. */
function initialValue(root: JsonObject, schema: JsonObject): Json {
  const inner = resolve(root, schema);
  const stated = [schema["default"], inner["default"], inner["const"]].find((value) => value !== undefined);
  if (stated !== undefined) return stated;
  if (nullableMember(root, inner)) return null;
  const variants = variantsOf(root, inner);
  if (variants?.[0]) return initialValue(root, variants[0].schema);
  if (Array.isArray(inner["enum"])) return inner["enum"][0] ?? null;
  if (isObject(inner["properties"])) return Object.fromEntries(propertiesOf(inner).map(([key, property]) => [key, initialValue(root, property)]));
  if (Array.isArray(inner["prefixItems"])) return inner["prefixItems"].filter(isObject).map((item) => initialValue(root, item));
  const [min, max] = [bound(inner, "minimum"), bound(inner, "maximum")];
  const middle = min !== null && max !== null ? (min + max) / 2 : (min ?? max ?? 0);
  return { array: [], boolean: false, string: "", number: middle, integer: middle }[text(inner["type"]) ?? ""] ?? null;
}

/** Every choice below a control, at any depth. */
export function choiceControls(control: Control): (ChoiceControl | NameControl)[] {
  switch (control.kind) {
    case "choice":
    case "name": return [control];
    case "group": return control.children.flatMap(choiceControls);
    case "optional": return control.inner ? choiceControls(control.inner) : [];
    case "list": return control.items.flatMap((item) => choiceControls(item.control));
    default: return [];
  }
}

export function schemaNamed(root: JsonObject, name: string): JsonObject | null {
  const schema = get(root, `/components/schemas/${name}`);
  return isObject(schema) ? schema : null;
}

/** "mask_tile" -> "mask tile". */
export const labelOf = (name: string) => name.replaceAll("_", " ");

/** Follows references. */
function resolve(root: JsonObject, schema: JsonObject): JsonObject {
  const reference = text(schema["$ref"]);
  if (reference === undefined) return schema;
  const target = get(root, reference.replace(/^#/, ""));
  return isObject(target) ? resolve(root, target) : schema;
}

/** The other member of a union with null. */
function nullableMember(root: JsonObject, schema: JsonObject): JsonObject | null {
  const any = schema["anyOf"];
  if (!Array.isArray(any)) return null;
  const members = any.filter(isObject);
  const rest = members.filter((member) => resolve(root, member)["type"] !== "null");
  return rest.length === 1 && rest.length < members.length ? (rest[0] ?? null) : null;
}

/** The members of a union, with their discriminator values. */
function variantsOf(root: JsonObject, schema: JsonObject): { tag: string | null; schema: JsonObject }[] | null {
  const union = schema["oneOf"] ?? schema["anyOf"];
  if (!Array.isArray(union)) return null;
  const key = discriminatorOf(root, schema);
  return union.filter(isObject).map((member) => ({ schema: member, tag: key === null ? null : tagOf(root, member, key) }));
}

function tagOf(root: JsonObject, schema: JsonObject, key: string): string | null {
  const property = get(resolve(root, schema), child("/properties", key));
  if (!isObject(property)) return null;
  const options = property["enum"];
  return text(property["const"]) ?? text(Array.isArray(options) ? options[0] : undefined) ?? null;
}

/** A union's discriminator: as stated, or the first constant field of a single model. */
function discriminatorOf(root: JsonObject, schema: JsonObject): string | null {
  const stated = get(schema, "/discriminator/propertyName");
  if (typeof stated === "string") return stated;
  return propertiesOf(resolve(root, schema)).find(([, property]) => "const" in property)?.[0] ?? null;
}

function array(root: JsonObject, schema: JsonObject, value: Json | undefined, labelled: LabelledField): Control | null {
  const prefix = schema["prefixItems"];
  if (Array.isArray(prefix)) {
    const members = prefix.filter(isObject).map((item) => resolve(root, item));
    const shares = members.every((item) => bound(item, "minimum") === 0 && bound(item, "maximum") === 1);
    if (members.length === 3 && shares) return { ...labelled, kind: "colour" };
    const names = members.length === 3 ? ["1", "2", "3"] : ["from", "to"];
    const children = members.flatMap((item, i) => controlOf(root, item, undefined, child(labelled.pointer, i), names[i] ?? String(i + 1)) ?? []);
    return { ...labelled, kind: "group", children };
  }
  const item = schema["items"];
  if (!isObject(item)) return null;
  const inner = resolve(root, item);
  const tagged = variantsOf(root, inner) ?? [{ schema: item, tag: null }];
  const discriminator = discriminatorOf(root, inner);
  const entries = Array.isArray(value) ? value : [];
  return {
    ...labelled,
    kind: "list",
    discriminator,
    minItems: bound(schema, "minItems") ?? 0,
    maxItems: bound(schema, "maxItems") ?? Infinity,
    variants: tagged.map(({ schema: member, tag }) => ({
      name: tag ?? (discriminator === null ? null : tagOf(root, member, discriminator)) ?? "item",
      hint: text(resolve(root, member)["description"]) ?? "",
      initial: initialValue(root, member),
    })),
    items: entries.flatMap((entry, i) => {
      const control = controlOf(root, item, entry, child(labelled.pointer, i), `${labelled.label} ${i + 1}`);
      const tag = discriminator !== null && isObject(entry) ? text(entry[discriminator]) : undefined;
      return control ? [{ control, variant: tag ?? null }] : [];
    }),
  };
}

function number(labelled: LabelledField, schema: JsonObject): NumberControl {
  const min = bound(schema, "minimum") ?? bound(schema, "exclusiveMinimum");
  const max = bound(schema, "maximum") ?? bound(schema, "exclusiveMaximum");
  const angle = schema["unit"] === RADIANS;
  const whole = schema["type"] === "integer";
  const logarithmic = min !== null && max !== null && min > 0 && Math.log10(max / min) > DECADES;
  const span = min !== null && max !== null ? max - min : null;
  // Finer than a slider's resolution, with few digits.
  const step = whole ? 1 : angle || logarithmic || span === null ? null : 10 ** Math.floor(Math.log10(span / 1e5));
  return { ...labelled, kind: "number", min, max, step, angle, logarithmic };
}

function choice(labelled: LabelledField, options: Json[]): ChoiceControl | null {
  const names = options.filter((option) => typeof option === "string");
  return names.length > 1 && names.length === options.length ? { ...labelled, kind: "choice", options: names } : null;
}

function bound(schema: JsonObject, key: string): number | null {
  const value = schema[key];
  return typeof value === "number" ? value : null;
}

const text = (value: Json | undefined) => (typeof value === "string" ? value : undefined);

/** Whether a panel may keep its widgets and change their values only. */
export function sameControls(a: Control | null, b: Control | null): boolean {
  return equal(JSON.parse(JSON.stringify(a)) as Json, JSON.parse(JSON.stringify(b)) as Json);
}

/** Controls of the scene's fields, without the camera's, which is moved in the picture. */
export function sceneControls(document: SceneSchema, scene: JsonObject): GroupControl | null {
  const schema = schemaNamed(document, "Scene");
  const control = schema && controlOf(document, schema, scene, "", "scene");
  if (control?.kind !== "group") return null;
  return { ...control, children: control.children.filter(({ pointer }) => pointer !== CAMERA_POINTER) };
}

export class ListedOptions {
  private readonly lists = new Map<string, readonly Choice[]>();

  /** `arrived`: called when a list is there. A list that could not be loaded is requested again when it is asked for. */
  constructor(
    private readonly load: (url: string) => Promise<readonly Choice[]>,
    private readonly arrived: () => void,
    private readonly failed: (error: unknown) => void,
  ) {}

  /** The options at an address; empty until they arrive. */
  from(url: string): readonly Choice[] {
    const known = this.lists.get(url);
    if (known) return known;
    this.lists.set(url, []);
    this.load(url).then(
      (options) => {
        this.lists.set(url, options);
        this.arrived();
      },
      (error: unknown) => {
        this.lists.delete(url);
        this.failed(error);
      },
    );
    return [];
  }
}
