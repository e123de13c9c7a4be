/** Opens the page: loads what the link in the address needs, and shows errors that prevent it. */
import "./style.css";
import { Api, ApiError, messageOf } from "./api";
import { linkOf } from "./app/address";
import { App } from "./app/app";
import { ChosenDisplay, type MakeDisplay } from "./display/chosendisplay";
import { ServerView } from "./display/serverview";
import { Viewport } from "./display/viewport";
import { CapabilityError } from "./gl/capabilities";
import { openContext, openGpu } from "./gl/gpu";
import { byId, element } from "./ui/dom";
import { LoadingScreen } from "./ui/overlays";
import { StillImage } from "./ui/still";

pinRoot();
const loadingScreen = new LoadingScreen(byId("loading"));

try {
  await start(new Api());
} catch (error) {
  if (error instanceof ApiError) {
    loadingScreen.fail(error.status === 0 ? "Server not reachable" : "Server error", error.message);
  } else {
    loadingScreen.fail("Unexpected error", messageOf(error));
    throw error;
  }
}

async function start(api: Api): Promise<void> {
  const link = linkOf(location);
  // The preset whose still the page shows already is requested before the list of presets arrives.
  const { preset: defaultPreset = "", stills = "" } = document.documentElement.dataset;
  const likely = link.preset ?? defaultPreset;
  const prefetch = stills.split(" ").includes(likely) ? api.preset(likely).catch(() => null) : null;
  const requests = Promise.all([api.presets(), prefetch]);
  // Awaited below.
  requests.catch(() => undefined);
  const still = new StillImage(byId("still") as HTMLImageElement);
  await still.whenPainted();
  // The browser starts the GPU while the server answers.
  const { makeDisplay, cannot } = openDisplay(api);
  const [presets, prefetched] = await requests;
  const linked = presets.find(({ name }) => name === link.preset);
  const summary = linked ?? presets[0];
  if (summary === undefined) throw new Error("The server lists no presets.");
  const preset = prefetched?.name === summary.name ? prefetched : await api.preset(summary.name);
  const notFound = link.preset !== null && linked === undefined;
  // The link's other parts belong to the missing preset.
  const usable = notFound ? { ...link, changes: [], touches: null, time: null, camera: null, split: null } : link;
  const app = new App(api, loadingScreen, still, { presets, preset, link: usable, makeDisplay });
  if (cannot !== null) byId("heading").append(element("p", { class: "notice mt-2.5 max-w-[42ch] text-note text-pretty" }, `The server draws the frames. ${cannot}`));
  if (notFound) app.toasts.show(`Preset “${link.preset}” not found. Showing “${preset.title}”.`, [], "error");
}

/**
 * Makes the folder that holds the page and its files the base of all relative addresses. Called once, when the page opens:
 * the path changes with the preset, and relative addresses would follow it.
 */
function pinRoot(): void {
  const base = document.querySelector("base") ?? document.head.appendChild(document.createElement("base"));
  base.href = new URL(".", document.baseURI).href;
}

/** Opens what can draw here, and says why nothing can. */
function openDisplay(api: Api): { makeDisplay: MakeDisplay; cannot: string | null } {
  const canvas = byId("canvas") as HTMLCanvasElement;
  const hidden = new Set((new URLSearchParams(location.search).get("hide") ?? "").split(",").filter(Boolean));
  let cannot: string | null = null;
  try {
    openGpu(openContext(canvas), hidden);
  } catch (error) {
    if (!(error instanceof CapabilityError)) throw error;
    cannot = error.message;
  }
  const makeDisplay: MakeDisplay = (loaders, events) =>
    new ChosenDisplay(cannot === null ? new Viewport(canvas, loaders, hidden, events) : null, new ServerView(api, canvas, loaders, events), cannot, events);
  return { makeDisplay, cannot };
}
