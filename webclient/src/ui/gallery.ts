/** The seas to choose from, group by group, as small pictures: files, so that nothing is drawn for them. */
import type { PresetSummary } from "../api";
import { element } from "./dom";
import { thumbnailOf } from "./still";

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
      // Those out of sight come when they are scrolled to.
      const image = element("img", { src: thumbnailOf(name), alt: "", width: 240, height: 135, loading: "lazy", decoding: "async" });
      const button = element("button", { type: "button", role: "option", title: summary }, image, element("span", {}, title));
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
}
