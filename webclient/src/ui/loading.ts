/** Covers the page while it loads, and shows errors that it cannot recover from. */
import { element } from "./dom";

export class LoadingScreen {
  constructor(private readonly container: HTMLElement) {
    this.container.replaceChildren(element("p", { class: "loading" }, "Seafoam"));
  }

  hide(): void {
    this.container.classList.add("done");
  }

  /** `button`: label of the button that reloads the page; null for none. */
  fail(title: string, message: string, button: string | null): void {
    this.container.classList.remove("done");
    this.container.classList.add("failed");
    const box = element("div", { class: "failure" }, element("h2", {}, title), element("p", {}, message));
    if (button !== null) {
      const reload = element("button", { class: "primary", type: "button" }, button);
      reload.addEventListener("click", () => location.reload());
      box.append(reload);
    }
    this.container.replaceChildren(box);
  }
}
