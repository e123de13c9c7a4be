/** Which place of the water a pixel shows; the scene's touches, how strong one is, where a drag leaves them, and how a link writes them. */
import { basis, type CameraState } from "../camera/state";
import { type Change, isObject, type Json, type JsonObject } from "../scene/json";

export interface WaterPlace {
  /** m */
  x: number;
  z: number;
  distance: number; // From the eye, m
}

const FARTHEST = 2000; // Places farther away are not touched, m: a ring there is smaller than a pixel

/** The place at (x, y) of a picture of width × height, from its upper left corner; null where no water is in reach. */
export function pickWater(camera: CameraState, x: number, y: number, width: number, height: number): WaterPlace | null {
  const { right, up, forward } = basis(camera);
  const q = Math.tan(camera.fov / 2);
  const along = ((2 * x) / width - 1) * q * (width / height);
  const upward = (1 - (2 * y) / height) * q;
  const [dx, dy, dz] = [0, 1, 2].map((i) => (forward[i] ?? 0) + along * (right[i] ?? 0) + upward * (up[i] ?? 0)) as [number, number, number];
  const [eyeX, eyeY, eyeZ] = camera.position;
  // From below, the surface is above.
  const far = -eyeY / dy;
  const distance = far * Math.hypot(dx, dy, dz);
  if (!(far > 0) || distance > FARTHEST) return null;
  return { x: eyeX + far * dx, z: eyeZ + far * dz, distance };
}

export const TOUCHES_POINTER = "/touches"; // The scene's list of touches
export const TOUCHES_MOST = 24; // Greatest length of the list: what plans have room for

/** Strength by distance, so that rings are as large in the picture near and far; limits, m. */
const STRENGTH = 0.0025;
const WEAKEST = 0.02;
const STRONGEST = 0.5;
/** Distance from ring to ring of a drag, by their strength: one and a half wavelengths, so that they stay rings. */
const SPACING = 28;
const TRAIN_MOST = 8; // Most rings of one move of a pointer

export interface Touch {
  /** m */
  x: number;
  z: number;
  time: number; // s
  strength: number; // m
}

const rounded = (value: number, digits: number) => Number(value.toFixed(digits));

/** A touch of the water at a place, to the centimetre and the hundredth of a second. */
export function touchAt({ x, z, distance }: WaterPlace, time: number): Touch {
  const strength = Math.min(STRONGEST, Math.max(WEAKEST, STRENGTH * distance));
  return { x: rounded(x, 2), z: rounded(z, 2), time: rounded(time, 2), strength: rounded(strength, 3) };
}

/** Places at equal distances along the way from the last touch to where the pointer is now; the nearest first. */
export function train(last: Touch, to: WaterPlace): WaterPlace[] {
  const length = Math.hypot(to.x - last.x, to.z - last.z);
  const spacing = SPACING * last.strength;
  const count = Math.min(TRAIN_MOST, Math.floor(length / spacing));
  return Array.from({ length: count }, (_, i) => {
    const share = ((i + 1) * spacing) / length;
    return { x: last.x + share * (to.x - last.x), z: last.z + share * (to.z - last.z), distance: to.distance };
  });
}

/** The list with more touches at its end; the oldest make room. */
export const appended = (touches: readonly Touch[], more: readonly Touch[]): Touch[] => [...touches, ...more].slice(-TOUCHES_MOST);

/** A scene's changes, its touches apart from the others; null touches: as in the preset. */
export function withoutTouches(changes: readonly Change[], scene: JsonObject): { changes: Change[]; touches: Touch[] | null } {
  const others = changes.filter(([pointer]) => pointer !== TOUCHES_POINTER && !pointer.startsWith(`${TOUCHES_POINTER}/`));
  return { changes: others, touches: others.length < changes.length ? touchesOf(scene) : null };
}

/** The touches of a scene; what is no touch is left out. */
export function touchesOf(scene: JsonObject): Touch[] {
  const list = scene["touches"];
  return Array.isArray(list) ? list.flatMap((entry) => fromJson(entry) ?? []) : [];
}

function fromJson(entry: Json): Touch | null {
  if (!isObject(entry) || !Array.isArray(entry["place"])) return null;
  const numbers = [...entry["place"], entry["time"], entry["strength"]];
  return numbers.length === 4 && numbers.every((n) => typeof n === "number") ? fromNumbers(numbers) : null;
}

export const toJson = (touches: readonly Touch[]): Json => touches.map(({ x, z, time, strength }) => ({ place: [x, z], time, strength }));

const fromNumbers = ([x = 0, z = 0, time = 0, strength = 0]: readonly number[]): Touch => ({ x, z, time, strength });

/** The list as a part of a link: four numbers a touch. */
export function encodeTouches(touches: readonly Touch[]): string {
  return touches.map(({ x, z, time, strength }) => [x, z, time, strength].join(",")).join("~");
}

/** The touches of a link's part; null without one that can be read. */
export function decodeTouches(text: string): Touch[] | null {
  const entries = text.split("~").map((entry) => entry.split(",").map((word) => (word === "" ? NaN : Number(word))));
  const touches = entries.filter((numbers) => numbers.length === 4 && numbers.every(Number.isFinite)).map(fromNumbers);
  return touches.length > 0 ? touches.slice(-TOUCHES_MOST) : null;
}
