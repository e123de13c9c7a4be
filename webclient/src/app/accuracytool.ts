/** Opens and closes the accuracy benchmark, whose code is loaded on first use. */
import type { AccuracyPanel } from "../accuracy/panel";

interface AccuracyToolEvents {
  toggled(open: boolean): void;
  failed(error: unknown): void;
}

export class AccuracyTool {
  open = false;
  private panel: AccuracyPanel | null = null;

  constructor(
    /** Null where the server draws: there is no GPU to measure. */
    private readonly makePanel: ((panel: typeof AccuracyPanel) => AccuracyPanel) | null,
    private readonly events: AccuracyToolEvents,
  ) {}

  get available(): boolean {
    return this.makePanel !== null;
  }

  /** `focus`: the panel takes the keyboard focus. */
  toggle(open = !this.open, focus = false): void {
    const { makePanel } = this;
    if (open === this.open || makePanel === null) return;
    this.open = open;
    this.events.toggled(open);
    if (this.panel) {
      this.panel.toggle(open, focus);
      return;
    }
    import("../accuracy/panel").then(
      ({ AccuracyPanel: Panel }) => {
        this.panel ??= makePanel(Panel);
        this.panel.toggle(this.open, focus);
      },
      (error: unknown) => {
        this.open = false;
        this.events.failed(error);
      },
    );
  }
}
