/** Drawers: panels that slide in beside the picture. */
import { button, element } from "./dom";
import { icon } from "./icons";

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
