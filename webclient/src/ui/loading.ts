/** Covers the page while it loads, and shows errors that it cannot recover from. */
import { button, element } from "./dom";

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
