/** Covers the page while it opens, and where it cannot go on. */
import { element } from "./dom";

export class Curtain {
  constructor(private readonly container: HTMLElement) {
    this.container.replaceChildren(element("div", { class: "opening" }, element("p", {}, "Seafoam")));
  }

  lift(): void {
    this.container.classList.add("lifted");
  }

  /** Says what is wrong and offers a way on. */
  fail(title: string, message: string, retry: string | null): void {
    this.container.classList.remove("lifted");
    this.container.classList.add("failed");
    const box = element("div", { class: "failure" }, element("h2", {}, title), element("p", {}, message));
    if (retry !== null) {
      const button = element("button", { class: "primary", type: "button" }, retry);
      button.addEventListener("click", () => location.reload());
      box.append(button);
    }
    this.container.replaceChildren(box);
  }
}
