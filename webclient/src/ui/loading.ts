/** Covers the page while it loads, and shows errors that it cannot recover from. */
import { element } from "./dom";

export class LoadingScreen {
  constructor(private readonly container: HTMLElement) {
    this.container.replaceChildren(element("p", { class: "loading" }, "Seafoam"));
  }

  hide(): void {
    this.container.classList.add("done");
  }

  /** Offers to load the page again; `link`: another way out. */
  fail(title: string, message: string, link: { text: string; href: string } | null = null): void {
    this.container.classList.remove("done");
    this.container.classList.add("failed");
    const box = element("div", { class: "failure" }, element("h2", {}, title), element("p", {}, message));
    const reload = element("button", { class: "primary", type: "button" }, "Reload page");
    reload.addEventListener("click", () => location.reload());
    box.append(reload);
    if (link) box.append(element("p", {}, element("a", { href: link.href }, link.text)));
    this.container.replaceChildren(box);
  }
}
