/** The seas to choose from, group by group, as small pictures that the server draws. */
import type { PresetSummary } from "../api";
import { element } from "./dom";

export class Gallery {
  private readonly buttons = new Map<string, HTMLButtonElement>();

  constructor(
    private readonly container: HTMLElement,
    presets: readonly PresetSummary[],
    choose: (name: string) => void,
  ) {
    let group = container;
    for (const { name, group: heading, title, summary } of presets) {
      if (group.getAttribute("aria-label") !== heading) {
        group = element("div", { role: "group", "aria-label": heading }, element("em", { "aria-hidden": "true" }, heading));
        container.append(group);
      }
      const button = element("button", { type: "button", role: "option", title: summary }, element("span", {}, title));
      button.addEventListener("click", () => choose(name));
      this.buttons.set(name, button);
      group.append(button);
    }
    container.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (step === undefined) return;
      const all = [...this.buttons.values()];
      const at = all.findIndex((button) => button === document.activeElement);
      all[Math.min(all.length - 1, Math.max(0, at + step))]?.focus();
      event.preventDefault();
    });
  }

  select(name: string): void {
    for (const [each, button] of this.buttons) button.setAttribute("aria-selected", String(each === name));
    const chosen = this.buttons.get(name);
    if (chosen) this.container.scrollLeft = chosen.offsetLeft - (this.container.clientWidth - chosen.offsetWidth) / 2;
  }

  /** Fills in the pictures one after another: the server has better things to do than to draw all at once. */
  async load(picture: (name: string) => Promise<Blob>): Promise<void> {
    for (const [name, button] of this.buttons) {
      try {
        const image = element("img", { src: URL.createObjectURL(await picture(name)), alt: "", width: 192, height: 108 });
        button.prepend(image);
      } catch {
        // Without a picture the title alone must do.
      }
    }
  }
}
