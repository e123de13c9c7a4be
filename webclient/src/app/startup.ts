/** Startup: loads what the link in the address needs and opens the page. */
import type { Api, Preset, PresetSummary } from "../api";
import { openContext } from "../gl/gpu";
import type { JsonObject } from "../scene/json";
import { byId } from "../ui/dom";
import type { LoadingScreen } from "../ui/loading";
import { StillImage } from "../ui/still";
import { App } from "./app";
import { decode, type LinkState } from "./url";

export interface StartData {
  presets: readonly PresetSummary[];
  openapi: JsonObject;
  preset: Preset;
  link: LinkState;
}

export async function start(api: Api, loadingScreen: LoadingScreen): Promise<void> {
  const link = decode(location.hash);
  // The preset whose still the page shows already is requested before the list of presets arrives.
  const { preset: defaultPreset = "", stills = "" } = document.documentElement.dataset;
  const likely = link.preset ?? defaultPreset;
  const prefetch = stills.split(" ").includes(likely) ? api.preset(likely).catch(() => null) : null;
  const requests = Promise.all([api.presets(), api.openapi(), prefetch]);
  // If WebGL cannot start either, that error is shown.
  requests.catch(() => undefined);
  const still = new StillImage(byId("still") as HTMLImageElement);
  await still.whenPainted();
  // The browser starts the GPU while the server answers.
  openContext(byId("canvas") as HTMLCanvasElement);
  const [presets, openapi, prefetched] = await requests;
  const linked = presets.find(({ name }) => name === link.preset);
  const summary = linked ?? presets[0];
  if (summary === undefined) throw new Error("The server lists no presets.");
  const preset = prefetched?.name === summary.name ? prefetched : await api.preset(summary.name);
  const notFound = link.preset !== null && linked === undefined;
  // The link's other parts belong to the missing preset.
  const usable = notFound ? { ...link, changes: [], time: null, camera: null, split: null } : link;
  const app = new App(api, loadingScreen, still, { presets, openapi, preset, link: usable });
  if (notFound) app.toasts.show(`Preset “${link.preset}” not found. Showing “${preset.title}”.`, [], "error");
}
