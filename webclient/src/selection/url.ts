/** The page's state as the fragment of a link. */
import type { Preset } from "../api";
import type { CameraState } from "../camera/state";
import type { FrameSource } from "../display/display";
import { apply, type Change, isObject, parsed } from "../scene/json";
import { decodeTouches, encodeTouches, toJson, type Touch, TOUCHES_POINTER } from "../touch/touches";
import { DEFAULT_TIER, type Selection, type Split, validSplit } from "./selection";

/** What a link can open beside the picture. */
export type SurfaceName = "take" | "plan";

export interface LinkState {
  preset: string | null;
  changes: readonly Change[];
  touches: readonly Touch[] | null; // The scene's touches; null: the preset's
  quality: string | null; // A tier, or settings as JSON
  time: number | null;
  paused: boolean | null;
  speed: number | null;
  camera: CameraState | null;
  split: Split | null;
  scale: number | null; // Fixed render scale; null: dynamic
  draw: FrameSource | null; // Who draws; null: whoever gives more
  accuracy: boolean | null;
  surface: SurfaceName | null;
}

const REMOVED = "-"; // Prefix of the pointer of a removed key

const MIN_SCALE = 0.05;
/** Greatest length of a link's fragment while it carries touches, bytes: mail and chats cut longer ones. */
const LINK_MOST = 2000;

/** Shortest text of a float64. */
const number = (x: number) => String(Object.is(x, -0) ? 0 : x);
const same = (text: string) => text;

/** Of a field of a link: its key, its text, null if it is left out, and what a text says, null if nothing. */
type Codec<T> = readonly [key: string, write: (value: NonNullable<T>) => string | null, read: (text: string) => T | null];

const CODECS: { readonly [Name in keyof LinkState]: Codec<LinkState[Name]> } = {
  preset: ["preset", same, same],
  time: ["time", number, finite],
  paused: ["paused", (paused) => (paused ? "1" : "0"), (text) => text === "1"],
  speed: ["speed", (speed) => (speed === 1 ? null : number(speed)), finite],
  quality: ["quality", same, same],
  camera: ["camera", ({ position, yaw, pitch, roll, fov }) => [...position, yaw, pitch, roll, fov].map(number).join(","), readCamera],
  changes: ["scene", writeChanges, readChanges],
  touches: ["touches", (touches) => (touches.length > 0 ? encodeTouches(touches) : null), decodeTouches],
  split: ["split", ({ field, left, right, at }) => [field, left, right, at.toFixed(3)].join("~"), readSplit],
  scale: ["scale", number, readScale],
  draw: ["draw", same, frameSource],
  accuracy: ["accuracy", (open) => (open ? "1" : null), (text) => (text === "1" ? true : null)],
  surface: ["open", same, (text) => (text === "take" || text === "plan" ? text : null)],
};

const FIELDS = Object.entries(CODECS) as [keyof LinkState, Codec<unknown>][];

/** The fragment, without the oldest touches where it would be too long with them. */
export function encode(state: LinkState): string {
  for (let touches = state.touches ?? []; touches.length > 0; touches = touches.slice(1)) {
    const text = encodeAll({ ...state, touches });
    // All but ASCII is escaped, so that characters are bytes.
    if (text.length <= LINK_MOST) return text;
  }
  return encodeAll({ ...state, touches: null });
}

function encodeAll(state: LinkState): string {
  // Characters that are legal in a fragment are not escaped, for readable links.
  const escape = (text: string) => encodeURIComponent(text).replace(/%(2C|2F|3A|7B|7D|5B|5D)/g, decodeURIComponent);
  const parts = FIELDS.flatMap(([name, [key, write]]) => {
    const value = state[name];
    const text = value === null ? null : write(value);
    return text === null ? [] : `${key}=${escape(text)}`;
  });
  return parts.join("&");
}

export function decode(fragment: string): LinkState {
  const parts = new Map<string, string>();
  for (const part of fragment.replace(/^#/, "").split("&")) {
    const at = part.indexOf("=");
    if (at <= 0) continue;
    try {
      parts.set(part.slice(0, at), decodeURIComponent(part.slice(at + 1)));
    } catch {
      // A truncated escape: this part is dropped.
    }
  }
  const found = FIELDS.map(([name, [key, , read]]) => {
    const text = parts.get(key);
    return [name, text === undefined ? null : read(text)] as const;
  });
  const state = Object.fromEntries(found) as { [Name in keyof LinkState]: LinkState[Name] | null };
  return { ...state, changes: state.changes ?? [] };
}

/** What a link selects of its preset. */
export function selectionFromLink(preset: Preset, link: LinkState): Selection {
  const touches: Change[] = link.touches ? [[TOUCHES_POINTER, toJson(link.touches)]] : [];
  const edited = apply(preset.scene, [...link.changes, ...touches]);
  const scene = isObject(edited) ? edited : preset.scene;
  return { preset, scene, quality: link.quality ?? DEFAULT_TIER, auto: link.quality === null, split: validSplit(scene, link.split) };
}

function finite(text: string): number | null {
  const value = text === "" ? NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}

function readScale(text: string): number | null {
  const value = finite(text);
  return value === null || value <= 0 ? null : Math.min(1, Math.max(MIN_SCALE, value));
}

export function frameSource(text: string | null): FrameSource | null {
  return text === "browser" || text === "server" ? text : null;
}

function readCamera(text: string): CameraState | null {
  const n = text.split(",").map(Number);
  if (n.length !== 7 || !n.every(Number.isFinite)) return null;
  const [x, y, z, yaw, pitch, roll, fov] = n as [number, number, number, number, number, number, number];
  return { position: [x, y, z], yaw, pitch, roll, fov };
}

function writeChanges(changes: readonly Change[]): string | null {
  const pairs = changes.map(([pointer, value]) => (value === undefined ? [REMOVED + pointer, 0] : [pointer, value]));
  return pairs.length === 0 ? null : JSON.stringify(Object.fromEntries(pairs));
}

function readChanges(text: string): Change[] | null {
  const changes = parsed(text);
  if (!isObject(changes)) return null;
  return Object.entries(changes).map(([key, value]) => (key.startsWith(REMOVED) ? [key.slice(REMOVED.length), undefined] : [key, value]));
}

function readSplit(text: string): Split | null {
  const [field, left, right, at = ""] = text.split("~");
  if (field === undefined || left === undefined || right === undefined) return null;
  return { field, left, right, at: Math.min(1, Math.max(0, finite(at) ?? 0.5)) };
}
