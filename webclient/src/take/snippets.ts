/** Commands and programs that ask the server for a frame. */
import { diff, type Json } from "../scene/json";
import { CAMERA_POINTER } from "../plan/rules";
import type { RecipeParts } from "./recipe";

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
