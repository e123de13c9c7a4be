/** Gallery of presets by group, with thumbnails. */
import type { PresetSummary } from "../api";
import { element } from "./dom";
import { thumbnailUrl } from "./still";

export class Gallery {
  private readonly buttons = new Map<string, HTMLButtonElement>();

  constructor(
    private readonly container: HTMLElement,
    presets: readonly PresetSummary[],
    onChoose: (name: string) => void,
  ) {
    let group = container;
    for (const { name, group: heading, title, summary } of presets) {
      if (group.getAttribute("aria-label") !== heading) {
        group = element("div", { role: "group", "aria-label": heading }, element("em", { "aria-hidden": "true" }, heading));
        container.append(group);
      }
      const image = element("img", { src: thumbnailUrl(name), alt: "", width: 240, height: 135, loading: "lazy", decoding: "async" });
      const button = element("button", { type: "button", role: "option", title: summary }, image, element("span", {}, title));
      button.addEventListener("click", () => onChoose(name));
      this.buttons.set(name, button);
      group.append(button);
    }
    container.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (step === undefined) return;
      const buttons = [...this.buttons.values()];
      const index = buttons.findIndex((button) => button === document.activeElement);
      buttons[Math.min(buttons.length - 1, Math.max(0, index + step))]?.focus();
      event.preventDefault();
    });
  }

  select(name: string): void {
    for (const [preset, button] of this.buttons) button.setAttribute("aria-selected", String(preset === name));
    const selected = this.buttons.get(name);
    if (selected) this.container.scrollLeft = selected.offsetLeft - (this.container.clientWidth - selected.offsetWidth) / 2;
  }
}
