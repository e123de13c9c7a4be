/** What lies over the picture: toasts, the screen that covers the page while it loads, the hint on how to begin, drawers. */
import { button, element } from "./dom";
import { icon } from "./icons";

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

const TEXT = "mb-6 wrap-anywhere text-soft";

export class LoadingScreen {
  constructor(private readonly container: HTMLElement) {
    this.container.replaceChildren(element("p", { class: "animate-pulse pl-[0.4em] font-serif text-[22px]/none tracking-[0.4em] text-soft" }, "Seafoam"));
  }

  hide(): void {
    this.container.classList.add("done");
  }

  /** Offers to load the page again; `link`: another way out. */
  fail(title: string, message: string, link: { text: string; href: string } | null = null): void {
    this.container.classList.remove("done");
    this.container.classList.add("failed");
    const box = element("div", { class: "failure max-w-[46ch] p-8 text-center" }, element("h2", { class: "mb-3 font-serif text-[28px]/[1.15]" }, title), element("p", { class: TEXT }, message));
    box.append(button({ class: "button" }, () => location.reload(), "Reload page"));
    if (link) box.append(element("p", { class: TEXT }, element("a", { class: "underline", href: link.href }, link.text)));
    this.container.replaceChildren(box);
  }
}

const HINT_DURATION = 30_000;
const FADE = 600;

/** Shows the hint above the bar; `touch`: where fingers are the main pointer. */
export function showHint(container: HTMLElement, touch: boolean): void {
  const text = touch ? "Touch the water · two fingers look around" : "Touch the water · right drag to look around · W A S D to move · / lists all waters · F fills the screen";
  const hint = element("p", { class: "hint pointer-events-none! justify-self-center rounded-sheet bg-panel px-4 py-2 text-center text-note text-soft transition-opacity duration-500 will-change-[opacity] [&.gone]:opacity-0" }, text);
  container.prepend(hint);
  const events = ["pointerdown", "keydown", "wheel"] as const;
  const leave = () => {
    events.forEach((type) => document.removeEventListener(type, leave));
    clearTimeout(timer);
    hint.classList.add("gone");
    setTimeout(() => hint.remove(), FADE);
  };
  const timer = setTimeout(leave, HINT_DURATION);
  events.forEach((type) => document.addEventListener(type, leave, { passive: true }));
}

/** A drawer's title, with a button that closes it. */
export function drawerHead(title: string, close: () => void, ...more: HTMLElement[]): HTMLElement {
  const heading = element("h2", { class: "flex-1 font-serif text-[17px]/none" }, title);
  return element("div", { class: "head flex items-center gap-2.5 pt-1 pr-1.5 pl-4.5" }, heading, ...more, button({ class: "plain", "aria-label": `Close ${title.toLowerCase()}` }, close, icon("close")));
}

/** Slides a drawer in or out, which the page's classes say by its name. */
export function slide(drawer: HTMLElement, name: string, open: boolean): void {
  drawer.classList.toggle("open", open);
  drawer.inert = !open;
  document.body.classList.toggle(`${name}-open`, open);
}
