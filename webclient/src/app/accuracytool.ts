/** Opens and closes the accuracy benchmark, whose code is loaded on first use. */
import type { AccuracyPanel } from "../accuracy/panel";

export interface AccuracyToolEvents {
  toggled(open: boolean): void;
  failed(error: unknown): void;
}

export class AccuracyTool {
  open = false;
  private panel: AccuracyPanel | null = null;

  constructor(
    private readonly makePanel: (panel: typeof AccuracyPanel) => AccuracyPanel,
    private readonly events: AccuracyToolEvents,
  ) {}

  /** `focus`: the panel takes the keyboard focus. */
  toggle(open = !this.open, focus = false): void {
    if (open === this.open) return;
    this.open = open;
    this.events.toggled(open);
    if (this.panel) {
      this.panel.toggle(open, focus);
      return;
    }
    import("../accuracy/panel").then(
      ({ AccuracyPanel: Panel }) => {
        this.panel ??= this.makePanel(Panel);
        this.panel.toggle(this.open, focus);
      },
      (error: unknown) => {
        this.open = false;
        this.events.failed(error);
      },
    );
  }
}
