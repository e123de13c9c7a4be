/** The seas to choose from, as small pictures that the server draws. */
import type { PresetSummary } from "../api";
import { element } from "./dom";

export class Gallery {
  private readonly buttons = new Map<string, HTMLButtonElement>();

  constructor(
    container: HTMLElement,
    presets: readonly PresetSummary[],
    picture: (name: string) => string,
    choose: (name: string) => void,
  ) {
    for (const { name, title, summary } of presets) {
      const image = element("img", { src: picture(name), alt: "", loading: "lazy", decoding: "async", width: 192, height: 108 });
      // Without a picture the title alone must do.
      image.addEventListener("error", () => image.remove());
      const button = element("button", { type: "button", role: "option", title: summary }, image, element("span", {}, title));
      button.addEventListener("click", () => choose(name));
      this.buttons.set(name, button);
      container.append(button);
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
    const strip = chosen?.parentElement;
    if (chosen && strip) strip.scrollLeft = chosen.offsetLeft - (strip.clientWidth - chosen.offsetWidth) / 2;
  }
}
