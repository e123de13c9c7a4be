/** Opens and closes the accuracy benchmark, whose code is loaded on first use. */
import type { AccuracyPanel } from "../accuracy/panel";
import type { Api } from "../api";
import type { Viewport } from "../display/viewport";
import type { Store } from "../selection/selection";

/** `quality`: a tier, or settings as JSON. */
interface AccuracyToolEvents { selectQuality(quality: string): void; toggled(open: boolean): void; failed(error: unknown): void; }

export class AccuracyTool {
  open = false;
  private panel: AccuracyPanel | null = null;

  constructor(
    private readonly api: Api,
    private readonly store: Store,
    /** Null where the server draws: there is no GPU to measure. */
    readonly viewport: Viewport | null,
    private readonly events: AccuracyToolEvents,
  ) {}

  /** `focus`: the panel takes the keyboard focus. */
  toggle(open = !this.open, focus = false): void {
    const { api, store, viewport, events } = this;
    if (open === this.open || viewport === null) return;
    this.open = open;
    events.toggled(open);
    if (this.panel) {
      this.panel.toggle(open, focus);
      return;
    }
    import("../accuracy/panel").then(
      ({ AccuracyPanel: Panel }) => {
        this.panel ??= new Panel(api, store, viewport, (quality) => events.selectQuality(quality), () => this.toggle(false));
        this.panel.toggle(this.open, focus);
      },
      (error: unknown) => {
        this.open = false;
        events.failed(error);
      },
    );
  }
}
