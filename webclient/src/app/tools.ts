/** The buttons at the top: what they do for the whole page, and files and links to take away. */
import type { PageContext } from "../surfaces/context";
import type { Surfaces } from "../surfaces/surfaces";
import type { TouchTool } from "../touch/tool";
import { button, byId, element, hasModifier, isTyping } from "../ui/dom";
import { icon, type IconName } from "../ui/icons";
import type { SettingsPanel } from "../ui/settings/settings";
import type { Toasts } from "../ui/overlays";
import type { AccuracyTool } from "./accuracytool";
import type { Address } from "./address";
import type { SceneEditor } from "./sceneeditor";

export interface PageParts {
  address: Address;
  toasts: Toasts;
  touch: TouchTool;
  editor: SceneEditor;
  context: PageContext;
  surfaces: Surfaces;
  accuracy: AccuracyTool;
  settings: SettingsPanel;
  failed: (error: unknown) => void;
}

/** Fills the row of tools. */
export function addTools(parts: PageParts): void {
  const { touch, editor, context, surfaces, accuracy, settings } = parts;
  byId("tools").append(touch.button);
  addTool("compare", "Compare side by side", () => void editor.toggleSplit());
  addTool("download", "Save image as PNG", () => void context.save(context.png(), ""));
  addTool("link", "Copy link to this view", () => void copyLink(parts));
  addTool("take", "Take home", () => surfaces.show(surfaces.open === "take" ? null : "take", true));
  addTool("plan", "Frame plan", () => surfaces.show(surfaces.open === "plan" ? null : "plan", true));
  if (accuracy.viewport !== null) addTool("accuracy", "Accuracy benchmark", () => accuracy.toggle(!accuracy.open, true));
  addToolLink("masks", "Mask laboratory", "./masks/");
  addToolLink("foam", "Foam laboratory", "./learn/laboratory/");
  addFullscreen(parts);
  addTool("settings", "Settings", () => {
    settings.toggle();
    editor.load();
    if (!settings.open) return;
    accuracy.toggle(false);
    surfaces.show(null);
  });
}

/** Adds a round button to the tools. Phones leave the screen to the page, and the heading needs the space. */
function addTool(name: IconName, label: string, run: () => void): void {
  byId("tools").append(button({ class: name === "fullscreen" ? "round phone:hidden" : "round", "data-tool": name, title: label, "aria-label": label }, run, icon(name)));
}

function addToolLink(name: IconName, label: string, href: string): void {
  byId("tools").append(element("a", { class: "round", "data-tool": name, href, title: label, "aria-label": label }, icon(name)));
}

export async function copyLink({ address, toasts }: PageParts): Promise<void> {
  const copied = await address.copy();
  toasts.show(copied ? "Link copied." : "Clipboard access denied. Copy the link from the address bar.");
}

/** Adds the button and the key F that fill the screen, where the browser can. */
function addFullscreen({ failed }: PageParts): void {
  if (!document.fullscreenEnabled) return;
  const toggle = () => {
    const done = document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
    done.catch(failed);
  };
  addTool("fullscreen", "Full screen (F)", toggle);
  document.addEventListener("keydown", (event) => {
    if (event.code === "KeyF" && !isTyping(event) && !hasModifier(event) && !event.repeat) toggle();
  });
}
