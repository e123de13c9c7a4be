/** The page of a scene taken home: draws from data in classic scripts, since pages on the file system may not fetch. */
import { messageOf } from "../api";
import type { FramePlan } from "../generated/api";
import { type Recipe, recipeOf, withRecipe } from "../take/recipe";
import { byId, download, prefersReducedMotion } from "../ui/dom";
import { PlanPlayer } from "./planplayer";

/** `textures`: SHA-256 -> base64. */
interface SeafoamData { plan: FramePlan; recipe: Recipe; textures: Record<string, string>; }

const bytesOf = (base64: string): ArrayBuffer => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)).buffer;

async function play({ plan, recipe, textures }: SeafoamData): Promise<void> {
  const canvas = byId("canvas") as HTMLCanvasElement;
  const reducedMotion = location.hash === "#paused" || prefersReducedMotion();
  const bytes = ({ url, sha256 }: FramePlan["textures"][string]) => {
    const text = textures[sha256];
    return text === undefined ? Promise.reject(new Error(`The archive lacks the texture ${url}.`)) : Promise.resolve(bytesOf(text));
  };
  const player = new PlanPlayer(canvas, { plan, bytes, time: recipe.time, camera: recipe.camera, playing: !reducedMotion, reducedMotion });
  player.controls.bottom = Math.min(player.controls.surface, recipe.camera.position[1]);
  player.failed = fail;
  const button = byId("play");
  const show = () => (button.textContent = player.playing ? "Pause" : "Play");
  button.addEventListener("click", () => {
    player.playing = !player.playing;
    show();
  });
  byId("save").addEventListener("click", () => void save(player, recipe).catch(fail));
  show();
  await player.load();
  document.documentElement.dataset["state"] = "ready";
}

/** Saves the picture with its recipe, as the application does. */
async function save(player: PlanPlayer, recipe: Recipe): Promise<void> {
  const { time, camera, canvas } = player;
  const png = await player.png();
  if (png === null) throw new Error("Nothing is drawn yet.");
  const { width, height } = canvas;
  const said = recipeOf({ ...recipe, time, camera, width, height });
  download(await withRecipe(png, said), `seafoam-${recipe.preset ?? "scene"}-${time.toFixed(2)}s.png`);
}

function fail(error: unknown): void {
  byId("failure").textContent = messageOf(error);
  document.documentElement.dataset["state"] = "failed";
}

const data = (globalThis as { seafoamData?: SeafoamData }).seafoamData;
if (data === undefined) fail(new Error("The folder data is missing: unpack the whole archive."));
else play(data).catch(fail);
