/** Short messages that go away by themselves; errors stay longer. */
import { element } from "./dom";

export class Toasts {
  constructor(private readonly container: HTMLElement) {}

  show(message: string, details: readonly string[] = [], kind: "note" | "error" = "note"): void {
    const text = element("div", {}, element("p", {}, message));
    if (details.length > 0) text.append(element("pre", {}, details.join("\n")));
    const toast = element("div", { class: `toast ${kind}` }, text);
    toast.addEventListener("click", () => toast.remove());
    // The same complaint twice is one complaint.
    for (const old of this.container.children) if (old.textContent === toast.textContent) old.remove();
    while (this.container.childElementCount > 2) this.container.firstElementChild?.remove();
    this.container.append(toast);
    setTimeout(() => toast.remove(), kind === "error" ? 12000 : 2600);
  }
}
