/**
 * The recipe of a picture: everything that it depends on, as JSON in the picture's file.
 *
 * The server writes the same members (server/seafoam/render/service/recipe.py) at the same places (server/seafoam/render/encode): an
 * iTXt chunk of a PNG (ISO 15948), a property in the XMP packet of a WebP (ISO 16684-1), an attribute in the header of an OpenEXR file.
 */
import { version } from "../../package.json";
import { cameraFromScene, type CameraState } from "../camera/state";
import { CAMERA_POINTER } from "../plan/rules";
import { diff, isObject, type Json, type JsonObject, parsed, withValue } from "../scene/json";
import type { Split } from "../selection/selection";
import type { LinkState } from "../selection/url";
import { withoutTouches } from "../touch/touches";

const KEYWORD = "seafoam"; // Keyword of PNG's chunk, name of OpenEXR's attribute
const XMP_NAMESPACE = "urn:seafoam:recipe:";
const PNG = "\x89PNG\r\n\x1a\n";
const EXR = "v/1\x01";
const EXR_HEADER = 8; // OpenEXR: bytes of its signature and version, before the first attribute
const EXR_NAME = 255; // Greatest length of a name, bytes
/** PNG: length and type before a chunk's data, and the checksum after it, bytes. */
const BEFORE = 8;
const AFTER = 4;

// Not a decoder: its "latin1" is windows-1252.
const latin = (bytes: Uint8Array) => String.fromCharCode(...bytes);
const utf8 = new TextDecoder();

/** The text; null if the picture has none, undefined if the file is of none of the three formats. */
function recipeText(bytes: Uint8Array): string | null | undefined {
  const start = latin(bytes.subarray(0, 12));
  if (start.startsWith(PNG)) return inPng(bytes);
  if (start.startsWith("RIFF") && start.endsWith("WEBP")) return inWebp(bytes);
  if (start.startsWith(EXR)) return inExr(bytes);
  return undefined;
}

function inPng(bytes: Uint8Array): string | null {
  const view = viewOf(bytes);
  for (let at = PNG.length; at + BEFORE + AFTER <= bytes.length; ) {
    const end = at + BEFORE + view.getUint32(at);
    if (end + AFTER > bytes.length) return null;
    if (latin(bytes.subarray(at + 4, at + BEFORE)) === "iTXt") {
      const data = bytes.subarray(at + BEFORE, end);
      const start = latin(data.subarray(0, KEYWORD.length + 5));
      if (start === `${KEYWORD}\0\0\0\0\0`) return utf8.decode(data.subarray(KEYWORD.length + 5));
    }
    at = end + AFTER;
  }
  return null;
}

function inWebp(bytes: Uint8Array): string | null {
  const view = viewOf(bytes);
  for (let at = 12; at + 8 <= bytes.length; ) {
    const length = view.getUint32(at + 4, true);
    if (latin(bytes.subarray(at, at + 4)) === "XMP ") {
      const packet = new DOMParser().parseFromString(utf8.decode(bytes.subarray(at + 8, at + 8 + length)), "application/xml");
      return packet.getElementsByTagNameNS(XMP_NAMESPACE, "recipe")[0]?.textContent ?? null;
    }
    // Chunks begin at even places.
    at += 8 + length + (length % 2);
  }
  return null;
}

function inExr(bytes: Uint8Array): string | null {
  const view = viewOf(bytes);
  const nameAt = (at: number) => {
    const name = bytes.subarray(at, at + EXR_NAME + 1);
    return latin(name.subarray(0, Math.max(name.indexOf(0), 0)));
  };
  // Attributes up to an empty name: name, type, length, value.
  for (let at = EXR_HEADER, name = nameAt(at); name !== ""; name = nameAt(at)) {
    const type = nameAt(at + name.length + 1);
    const value = at + name.length + type.length + 6;
    if (value > bytes.length) return null;
    const end = value + view.getUint32(value - 4, true);
    if (name === KEYWORD && type === "string") return utf8.decode(bytes.subarray(value, end));
    at = end;
  }
  return null;
}

const viewOf = (bytes: Uint8Array) => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

const HEADER = 33; // Bytes of a PNG's signature and of IHDR, which comes first
/** What says before a PNG's pixels which colours they are; of some browsers' pictures nothing does. */
const COLOURS = /sRGB|iCCP|cICP/;
const RECIPE = 1; // Version of the format
const TIME_LIMIT = 1e9; // Greatest |time|, s

/** What a picture depends on. */
export interface RecipeParts {
  renderer: string;
  preset: string | null; // Preset that the scene began from
  scene: JsonObject;
  quality: Json; // A tier, or the settings that differ from tier standard
  camera: CameraState;
  time: number; // s
  width: number;
  height: number;
  split: Split | null; // Two looks side by side, in pictures of the page
}

export interface Recipe extends RecipeParts {
  recipe: number;
  seafoam: string; // Version of the program
}

/** The file has no recipe, or not one that can be read; the message is for the user. */
export class RecipeError extends Error {
  override readonly name = "RecipeError";
}

/** A recipe of this version of the program. */
export const recipeOf = (parts: RecipeParts): Recipe => ({ ...parts, recipe: RECIPE, seafoam: version });

/** The PNG with the recipe in a chunk after its header, tagged as sRGB. */
export async function withRecipe(png: Blob, recipe: Recipe): Promise<Blob> {
  const bytes = new Uint8Array(await png.arrayBuffer());
  const before = new TextDecoder("latin1").decode(bytes).split("IDAT", 1)[0] ?? "";
  const colours = COLOURS.test(before) ? [] : [chunkOf("sRGB", "\0")];
  // Keyword, not compressed, no language, no translated keyword.
  const note = chunkOf("iTXt", `${KEYWORD}\0\0\0\0\0${JSON.stringify(recipe)}`);
  return new Blob([bytes.slice(0, HEADER), ...colours, note, bytes.slice(HEADER)], { type: "image/png" });
}

function chunkOf(type: string, content: string): Uint8Array<ArrayBuffer> {
  const data = new TextEncoder().encode(type + content);
  const chunk = new Uint8Array(BEFORE - type.length + data.length + AFTER);
  const view = new DataView(chunk.buffer);
  view.setUint32(0, data.length - type.length);
  chunk.set(data, BEFORE - type.length);
  view.setUint32(chunk.length - AFTER, crc32(data));
  return chunk;
}

/** The recipe in a PNG, WebP or OpenEXR file; throws a `RecipeError` if there is none. */
export async function readRecipe(file: Blob): Promise<Recipe> {
  const text = recipeText(new Uint8Array(await file.arrayBuffer()));
  if (text === undefined) throw new RecipeError("This file is not a PNG, WebP or OpenEXR picture.");
  if (text === null) throw new RecipeError("This picture has no recipe. Pictures saved here, or rendered by the server, have one.");
  return checked(parsed(text));
}

function checked(value: Json | undefined): Recipe {
  if (value === undefined) throw new RecipeError("The picture's recipe is damaged.");
  if (!isObject(value) || value["recipe"] !== RECIPE) throw new RecipeError("The picture's recipe is of another version of the program.");
  const { scene, quality, camera, time, preset, split } = value;
  const position = isObject(camera) ? camera["position"] : null;
  const isNumber = (candidate: Json | undefined) => typeof candidate === "number" && Number.isFinite(candidate);
  const cameraIsValid =
    isObject(camera) && Array.isArray(position) && position.length === 3 && position.every(isNumber) && ["yaw", "pitch", "roll", "fov"].every((angle) => isNumber(camera[angle]));
  const qualityIsValid = typeof quality === "string" || isObject(quality);
  const timeIsValid = typeof time === "number" && Math.abs(time) <= TIME_LIMIT;
  if (!isObject(scene) || !cameraIsValid || !qualityIsValid || !timeIsValid) throw new RecipeError("The picture's recipe is damaged.");
  const known = { preset: typeof preset === "string" ? preset : null, split: isSplit(split) ? split : null };
  return { ...value, ...known } as unknown as Recipe;
}

function isSplit(value: Json | undefined): boolean {
  return isObject(value) && typeof value["at"] === "number" && ["field", "left", "right"].every((name) => typeof value[name] === "string");
}

/** The link that restores a recipe, given the preset that it begins from: paused, at its time, from its camera. */
export function linkOf(recipe: Recipe, preset: { name: string; scene: JsonObject }): LinkState {
  const { quality, time, split } = recipe;
  // The link has the camera apart from the scene's fields.
  const scene = withValue(recipe.scene, CAMERA_POINTER, preset.scene["camera"]);
  return {
    preset: preset.name,
    ...withoutTouches(diff(preset.scene, scene), recipe.scene),
    quality: typeof quality === "string" ? quality : JSON.stringify(quality),
    ...{ time, paused: true, split, camera: cameraFromScene({ camera: recipe.camera }) },
    ...{ speed: null, scale: null, draw: null, accuracy: null, surface: null },
  };
}

/** CRC-32 of ISO 15948, annex D. */
export function crc32(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

/** A frame's request: by query for a preset as it is, else with a JSON body. */
interface HttpRequest { url: string; body: string | null; }

/** `preset`: the preset that the recipe begins from, `null` if unknown. */
export function requestOf(recipe: RecipeParts, preset: { name: string; scene: Json } | null, server: string): HttpRequest {
  const { scene, quality, camera, time, width, height } = recipe;
  const url = new URL("api/frames", server);
  const isOwn = ([pointer]: readonly [string, unknown]) => pointer !== CAMERA_POINTER && !pointer.startsWith(`${CAMERA_POINTER}/`);
  if (preset !== null && typeof quality === "string" && !diff(preset.scene, scene).some(isOwn)) {
    const { position: [x, y, z], yaw, pitch, roll, fov } = camera;
    url.pathname += `/${preset.name}.png`;
    const query = { quality, time, width, height, x, y, z, yaw, pitch, roll, fov, dither: false };
    for (const [name, value] of Object.entries(query)) url.searchParams.set(name, String(value));
    return { url: url.href, body: null };
  }
  return { url: url.href, body: JSON.stringify(exactFrame(recipe)) };
}

/** Members of a recipe that the server takes. */
export function frameBody({ scene, quality, camera, time, width, height, preset }: RecipeParts) {
  return { preset, scene, quality, camera, time, width, height };
}

/** The request of a recipe's frame, rounded as the page rounds: the two pictures can be compared. */
export const exactFrame = (recipe: RecipeParts) => ({ ...frameBody(recipe), dither: false });

const quoted = (text: string) => `'${text.replaceAll("'", "'\\''")}'`;

export function curl({ url, body }: HttpRequest): string {
  if (body === null) return `curl --fail ${quoted(url)} -o frame.png`;
  return `curl --fail ${quoted(url)} -o frame.png -H 'Content-Type: application/json' --data-binary ${quoted(body)}`;
}

/** A JSON string is a Python string too, and a JavaScript one. */
const literal = (text: string) => JSON.stringify(text);

export function python({ url, body }: HttpRequest): string {
  const given =
    body === null
      ? [`request = urllib.request.Request(${literal(url)})`]
      : [`body = ${literal(body)}`, `headers = {"Content-Type": "application/json"}`, `request = urllib.request.Request(${literal(url)}, body.encode(), headers)`];
  const save = ["with urllib.request.urlopen(request) as response:", `    pathlib.Path("frame.png").write_bytes(response.read())`];
  return ["import pathlib", "import urllib.request", "", ...given, ...save].join("\n");
}

/** For Node 20 and newer. */
export function javascript({ url, body }: HttpRequest): string {
  const given =
    body === null
      ? [`const response = await fetch(${literal(url)});`]
      : [
          `const body = ${literal(body)};`,
          `const headers = { "Content-Type": "application/json" };`,
          `const response = await fetch(${literal(url)}, { method: "POST", headers, body });`,
        ];
  return [
    `import { writeFile } from "node:fs/promises";`,
    "",
    ...given,
    "if (!response.ok) throw new Error(await response.text());",
    `await writeFile("frame.png", new Uint8Array(await response.arrayBuffer()));`,
  ].join("\n");
}
