/** Messages that disappear after a while. */
import { element } from "./dom";

const DURATION = { note: 2600, error: 12000 };

const SHADOWS = {
  note: "shadow-[inset_0_0_0_1px_var(--color-line),0_8px_30px_rgb(0_0_0/35%)]",
  error: "shadow-[inset_3px_0_0_var(--color-error),inset_0_0_0_1px_var(--color-line),0_8px_30px_rgb(0_0_0/35%)]",
};

export class Toasts {
  constructor(private readonly container: HTMLElement) {}

  show(message: string, details: readonly string[] = [], kind: "note" | "error" = "note"): void {
    const text = element("div", {}, element("p", {}, message));
    if (details.length > 0) text.append(element("pre", { class: "mt-1.5 max-h-45 overflow-auto text-small/[1.5] wrap-anywhere whitespace-pre-wrap text-soft" }, details.join("\n")));
    const toast = element("div", { class: `toast ${kind} pointer-events-auto max-w-full animate-toast cursor-pointer rounded-xl bg-solid px-4.5 py-[11px] ${SHADOWS[kind]}` }, text);
    toast.addEventListener("click", () => toast.remove());
    for (const previous of this.container.children) if (previous.textContent === toast.textContent) previous.remove();
    while (this.container.childElementCount > 2) this.container.firstElementChild?.remove();
    this.container.append(toast);
    setTimeout(() => toast.remove(), DURATION[kind]);
  }
}
