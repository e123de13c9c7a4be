/** Messages that disappear after a while. */
import "./messages.css";
import { element } from "./dom";

const DURATION = { note: 2600, error: 12000 };

export class Toasts {
  constructor(private readonly container: HTMLElement) {}

  show(message: string, details: readonly string[] = [], kind: "note" | "error" = "note"): void {
    const text = element("div", {}, element("p", {}, message));
    if (details.length > 0) text.append(element("pre", {}, details.join("\n")));
    const toast = element("div", { class: `toast ${kind}` }, text);
    toast.addEventListener("click", () => toast.remove());
    for (const previous of this.container.children) if (previous.textContent === toast.textContent) previous.remove();
    while (this.container.childElementCount > 2) this.container.firstElementChild?.remove();
    this.container.append(toast);
    setTimeout(() => toast.remove(), DURATION[kind]);
  }
}
