/**
 * The recipe of a picture: everything that it depends on, as JSON in the picture's file.
 *
 * The server writes the same members (server/seafoam/render/service/recipe.py).
 */
import { version } from "../../package.json";
import { type CameraState, cameraFromScene } from "../camera/state";
import { CAMERA_POINTER } from "../plan/live";
import { diff, isObject, type Json, type JsonObject, withValue } from "../scene/json";
import type { Split } from "../selection/selection";
import type { LinkState } from "../selection/url";
import { withoutTouches } from "../touch/touches";
import { AFTER, BEFORE, KEYWORD, recipeText } from "./recipetext";

/** Bytes of a PNG's signature and of IHDR, which comes first. */
const HEADER = 33;
/** What says before a PNG's pixels which colours they are; of some browsers' pictures nothing does. */
const COLOURS = /sRGB|iCCP|cICP/;
/** Version of the format. */
const RECIPE = 1;
/** Greatest |time|, s. */
const TIME_LIMIT = 1e9;

/** What a picture depends on. */
export interface RecipeParts {
  renderer: string;
  /** Preset that the scene began from. */
  preset: string | null;
  scene: JsonObject;
  /** A tier, or the settings that differ from tier standard. */
  quality: Json;
  camera: CameraState;
  /** s */
  time: number;
  width: number;
  height: number;
  /** Two looks side by side, in pictures of the page. */
  split: Split | null;
}

export interface Recipe extends RecipeParts {
  recipe: number;
  /** Version of the program. */
  seafoam: string;
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
  let parsed: Json;
  try {
    parsed = JSON.parse(text) as Json;
  } catch {
    throw new RecipeError("The picture's recipe is damaged.");
  }
  return checked(parsed);
}

function checked(value: Json): Recipe {
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
