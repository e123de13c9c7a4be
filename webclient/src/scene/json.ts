/** Scenes as plain JSON, addressed by JSON pointers. */

export type Json = null | boolean | number | string | Json[] | JsonObject;
export interface JsonObject { [key: string]: Json; }

export const isObject = (value: Json | undefined): value is JsonObject => typeof value === "object" && value !== null && !Array.isArray(value);

/** What a JSON text says; undefined where it is none. */
export function parsed(text: string): Json | undefined {
  try {
    return JSON.parse(text) as Json;
  } catch {
    return undefined;
  }
}

/** The steps of a JSON pointer (RFC 6901). */
export function steps(pointer: string): string[] {
  if (pointer === "") return [];
  return pointer.slice(1).split("/").map((step) => step.replaceAll("~1", "/").replaceAll("~0", "~"));
}

export const child = (pointer: string, step: string | number): string => `${pointer}/${String(step).replaceAll("~", "~0").replaceAll("/", "~1")}`;

/** The value that a pointer names, or undefined. */
export function get(root: Json, pointer: string): Json | undefined {
  let value: Json | undefined = root;
  for (const step of steps(pointer)) {
    if (Array.isArray(value)) value = value[Number(step)];
    else if (isObject(value)) value = value[step];
    else return undefined;
  }
  return value;
}

/** A copy with the value set; `undefined` removes the key. Unchanged parts are shared. */
export function withValue(root: Json, pointer: string, value: Json | undefined): Json {
  const path = steps(pointer);
  const put = (node: Json | undefined, depth: number): Json | undefined => {
    const step = path[depth];
    if (step === undefined) return value;
    const inner = put(get(node ?? {}, child("", step)), depth + 1);
    if (Array.isArray(node)) {
      const copy = [...node];
      if (inner === undefined) copy.splice(Number(step), 1);
      else copy[Number(step)] = inner;
      return copy;
    }
    const copy = isObject(node) ? { ...node } : {};
    if (inner === undefined) Reflect.deleteProperty(copy, step);
    else copy[step] = inner;
    return copy;
  };
  return put(root, 0) ?? {};
}

export function equal(a: Json | undefined, b: Json | undefined): boolean {
  if (a === b) return true;
  if (Array.isArray(a)) return Array.isArray(b) && a.length === b.length && a.every((item, i) => equal(item, b[i]));
  if (!isObject(a) || !isObject(b)) return false;
  const keys = Object.keys(a);
  return keys.length === Object.keys(b).length && keys.every((key) => key in b && equal(a[key], b[key]));
}

/** A pointer and its new value; undefined if removed. */
export type Change = readonly [pointer: string, value: Json | undefined];

/** Changes that turn `from` into `to`; lists of different length are replaced. */
export function diff(from: Json | undefined, to: Json | undefined, pointer = ""): Change[] {
  if (equal(from, to)) return [];
  if (isObject(from) && isObject(to)) {
    const keys = [...new Set([...Object.keys(from), ...Object.keys(to)])].sort();
    return keys.flatMap((key) => diff(from[key], to[key], child(pointer, key)));
  }
  if (Array.isArray(from) && Array.isArray(to) && from.length === to.length) {
    return from.flatMap((item, i) => diff(item, to[i], child(pointer, i)));
  }
  return [[pointer, to]];
}

export const apply = (root: Json, changes: readonly Change[]): Json => changes.reduce((value, [pointer, to]) => withValue(value, pointer, to), root);
