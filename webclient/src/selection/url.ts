/** The page's state as the fragment of a link. */
import type { Preset } from "../api";
import type { CameraState } from "../camera/state";
import type { FrameSource } from "../display/display";
import { apply, type Change, isObject, type Json } from "../scene/json";
import { decodeTouches, encodeTouches, toJson, type Touch, TOUCHES_POINTER } from "../touch/touches";
import { DEFAULT_TIER, type Selection, type Split, validSplit } from "./selection";

/** What a link can open beside the picture. */
export type SurfaceName = "take" | "plan";

export interface LinkState {
  preset: string | null;
  changes: readonly Change[];
  /** The scene's touches; null: the preset's. */
  touches: readonly Touch[] | null;
  /** A tier, or settings as JSON. */
  quality: string | null;
  time: number | null;
  paused: boolean | null;
  speed: number | null;
  camera: CameraState | null;
  split: Split | null;
  /** Fixed render scale; null: dynamic. */
  scale: number | null;
  /** Who draws; null: whoever gives more. */
  draw: FrameSource | null;
  accuracy: boolean | null;
  surface: SurfaceName | null;
}

/** Prefix of the pointer of a removed key. */
const REMOVED = "-";

const MIN_SCALE = 0.05;
/** Greatest length of a link's fragment while it carries touches, bytes: mail and chats cut longer ones. */
const LINK_MOST = 2000;

/** Shortest text of a float64. */
const number = (x: number) => String(Object.is(x, -0) ? 0 : x);

/** The fragment, without the oldest touches where it would be too long with them. */
export function encode(state: LinkState): string {
  for (let touches = state.touches ?? []; touches.length > 0; touches = touches.slice(1)) {
    const text = encodeAll(state, touches);
    // All but ASCII is escaped, so that characters are bytes.
    if (text.length <= LINK_MOST) return text;
  }
  return encodeAll(state, []);
}

function encodeAll(state: LinkState, touches: readonly Touch[]): string {
  const parts = new Map<string, string>();
  const put = (key: string, value: string | null) => {
    if (value !== null) parts.set(key, value);
  };
  put("preset", state.preset);
  put("time", state.time === null ? null : number(state.time));
  put("paused", state.paused === null ? null : state.paused ? "1" : "0");
  put("speed", state.speed === null || state.speed === 1 ? null : number(state.speed));
  put("quality", state.quality);
  if (state.camera) {
    const { position, yaw, pitch, roll, fov } = state.camera;
    put("camera", [...position, yaw, pitch, roll, fov].map(number).join(","));
  }
  if (state.changes.length > 0) {
    const pairs = state.changes.map(([pointer, value]) => (value === undefined ? [REMOVED + pointer, 0] : [pointer, value]));
    put("scene", JSON.stringify(Object.fromEntries(pairs)));
  }
  put("touches", touches.length > 0 ? encodeTouches(touches) : null);
  if (state.split) {
    const { field, left, right, at } = state.split;
    put("split", [field, left, right, at.toFixed(3)].join("~"));
  }
  put("scale", state.scale === null ? null : number(state.scale));
  put("draw", state.draw);
  put("accuracy", state.accuracy ? "1" : null);
  put("open", state.surface);
  // Characters that are legal in a fragment are not escaped, for readable links.
  const escape = (text: string) =>
    encodeURIComponent(text).replace(/%(2C|2F|3A|7B|7D|5B|5D|22)/g, (code) =>
      code === "%22" ? code : decodeURIComponent(code),
    );
  return [...parts].map(([key, value]) => `${key}=${escape(value)}`).join("&");
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
  const open = parts.get("open");
  return {
    preset: parts.get("preset") ?? null,
    changes: changes(parts.get("scene")),
    touches: decodeTouches(parts.get("touches")),
    quality: parts.get("quality") ?? null,
    time: finite(parts.get("time")),
    paused: parts.has("paused") ? parts.get("paused") === "1" : null,
    speed: finite(parts.get("speed")),
    camera: camera(parts.get("camera")),
    split: split(parts.get("split")),
    scale: scale(parts.get("scale")),
    draw: frameSource(parts.get("draw")),
    accuracy: parts.get("accuracy") === "1" ? true : null,
    surface: open === "take" || open === "plan" ? open : null,
  };
}

/** What a link selects of its preset. */
export function selectionFromLink(preset: Preset, link: LinkState): Selection {
  const touches: Change[] = link.touches ? [[TOUCHES_POINTER, toJson(link.touches)]] : [];
  const edited = apply(preset.scene, [...link.changes, ...touches]);
  const scene = isObject(edited) ? edited : preset.scene;
  return { preset, scene, quality: link.quality ?? DEFAULT_TIER, auto: link.quality === null, split: validSplit(scene, link.split) };
}

function finite(text: string | undefined): number | null {
  const value = text === undefined || text === "" ? NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}

function scale(text: string | undefined): number | null {
  const value = finite(text);
  return value === null || value <= 0 ? null : Math.min(1, Math.max(MIN_SCALE, value));
}

export function frameSource(text: string | null | undefined): FrameSource | null {
  return text === "browser" || text === "server" ? text : null;
}

function camera(text: string | undefined): CameraState | null {
  const n = text?.split(",").map(Number) ?? [];
  if (n.length !== 7 || !n.every(Number.isFinite)) return null;
  const [x, y, z, yaw, pitch, roll, fov] = n as [number, number, number, number, number, number, number];
  return { position: [x, y, z], yaw, pitch, roll, fov };
}

function changes(text: string | undefined): Change[] {
  if (text === undefined) return [];
  let parsed: Json;
  try {
    parsed = JSON.parse(text) as Json;
  } catch {
    return [];
  }
  if (!isObject(parsed)) return [];
  return Object.entries(parsed).map(([key, value]) =>
    key.startsWith(REMOVED) ? [key.slice(REMOVED.length), undefined] : [key, value],
  );
}

function split(text: string | undefined): Split | null {
  const [field, left, right, at] = text?.split("~") ?? [];
  if (field === undefined || left === undefined || right === undefined) return null;
  const share = finite(at) ?? 0.5;
  return { field, left, right, at: Math.min(1, Math.max(0, share)) };
}
