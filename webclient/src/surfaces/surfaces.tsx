/** Opens and closes surfaces beside the picture, one at a time; their code is loaded on first use. */
import { type ComponentType, render } from "preact";
import type { SurfaceName } from "../selection/url";
import { element } from "../ui/dom";
import type { PageContext } from "./context";

const SURFACES: Record<SurfaceName, { title: string; load: () => Promise<{ Surface: ComponentType<{ context: PageContext }> }> }> = {
  take: { title: "Take home", load: () => import("../take/surface") },
  plan: { title: "Frame plan", load: () => import("../planview/surface") },
};

interface SurfaceEvents { toggled(open: SurfaceName | null): void; failed(error: unknown): void; }

export class Surfaces {
  open: SurfaceName | null = null;
  private sheet: HTMLElement | null = null;
  private opener: Element | null = null; // Takes the focus when the surface closes

  constructor(private readonly context: PageContext, private readonly events: SurfaceEvents) {}

  /** Opens a surface, or closes the open one. `focus`: the surface takes the keyboard focus. */
  show(name: SurfaceName | null, focus = false): void {
    if (name === this.open) return;
    this.remove();
    this.open = name;
    this.events.toggled(name);
    if (name === null) return;
    const { title, load } = SURFACES[name];
    this.opener = focus ? document.activeElement : null;
    const sheet = element("section", { class: "sheet data-[surface=plan]:[--width:820px]", role: "dialog", "aria-label": title, tabindex: -1, "data-surface": name });
    this.sheet = sheet;
    sheet.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.show(null);
    });
    document.body.append(sheet);
    load().then(
      ({ Surface }) => {
        if (this.sheet !== sheet) return;
        render(<Surface context={this.context} />, sheet);
        if (focus) sheet.focus();
      },
      (error: unknown) => {
        if (this.sheet === sheet) this.show(null);
        this.events.failed(error);
      },
    );
  }

  private remove(): void {
    const { sheet, opener } = this;
    const hadFocus = sheet?.contains(document.activeElement) ?? false;
    if (sheet) render(null, sheet);
    sheet?.remove();
    this.sheet = this.opener = null;
    if (hadFocus && opener instanceof HTMLElement) opener.focus();
  }
}
