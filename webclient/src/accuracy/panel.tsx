/** Accuracy benchmark panel: measures time and error of every quality on this GPU. */
import { render } from "preact";
import type { Api } from "../api";
import type { Viewport } from "../display/viewport";
import type { Store } from "../selection/store";
import { element } from "../ui/dom";
import { drawerHead, slide } from "../ui/drawer";
import { Session } from "./session";
import { View } from "./view";

/** `wide`: with the server's diagram. */
const PANEL =
  "group/panel drawer w-[min(520px,var(--spacing-inner))] bg-[rgb(8_17_26/94%)] tabular-nums shadow-[inset_0_0_0_1px_var(--color-line),0_18px_50px_rgb(0_0_0/30%)] focus-visible:outline-none " +
  "[&.wide]:w-[min(860px,var(--spacing-inner))] phone:max-h-[min(66dvh,620px)] phone:w-auto! phone:bg-solid phone:pb-[calc(64px+env(safe-area-inset-bottom))]";

export class AccuracyPanel {
  private readonly root = element("aside", { id: "accuracy", class: PANEL, "aria-label": "Accuracy benchmark", tabindex: -1 });
  private readonly session: Session;

  constructor(api: Api, store: Store, viewport: Viewport, selectQuality: (quality: string) => void, close: () => void) {
    this.session = new Session(api, store, viewport, selectQuality);
    this.root.addEventListener("keydown", (event) => {
      if (event.key === "Escape") close();
    });
    const body = element("div", { class: "body scroller px-4.5 pb-4" });
    this.root.append(drawerHead("Accuracy benchmark", close), body);
    this.root.inert = true;
    document.getElementById("settings")?.after(this.root);
    this.session.sweep.subscribe((sweep) => this.root.classList.toggle("wide", sweep !== null));
    render(<View session={this.session} />, body);
  }

  toggle(open: boolean, focus: boolean): void {
    const { session, root } = this;
    if (open === session.open.value) return;
    const hadFocus = root.contains(document.activeElement);
    // A layout while closed, so that opening is animated.
    root.getBoundingClientRect();
    slide(root, "accuracy", open);
    session.open.value = open;
    if (open && focus) root.focus({ preventScroll: true });
    if (!open && hadFocus) document.querySelector<HTMLElement>("#tools [data-tool=accuracy]")?.focus();
  }
}
