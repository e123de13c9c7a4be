/** The server's measurement of the same qualities, requested on demand. */
import type { Api } from "../api";
import { element } from "../ui/dom";
import { fetchSweep, type Sweep } from "./api";
import type { BenchmarkResult } from "./benchmark";
import type { Mark } from "./chart";

export class ServerMeasurement {
  private readonly checkbox = element("input", { type: "checkbox" });
  private readonly note = element("span", { class: "fine" });
  readonly root = element("label", { class: "server" }, this.checkbox, element("span", {}, element("i"), "Server measurement ", this.note));
  /** By preset. */
  private readonly sweeps = new Map<string, Sweep>();
  private request: AbortController | null = null;

  constructor(
    private readonly api: Api,
    private readonly preset: () => string,
    private readonly changed: () => void,
  ) {
    this.checkbox.addEventListener("change", () => void this.update());
  }

  cancel(): void {
    this.request?.abort();
  }

  /** Shows the state for the current preset. */
  reset(): void {
    this.cancel();
    this.checkbox.checked = this.sweeps.has(this.preset());
    this.note.textContent = "";
  }

  /** Marks for the chart: times predicted at the benchmark's size. */
  marks({ sizes: { large } }: BenchmarkResult): Mark[] {
    if (!this.checkbox.checked) return [];
    return (this.sweeps.get(this.preset())?.points ?? []).map(({ id, label, tier, model, error }) => {
      const time = model.fixed_ms + 1e-6 * model.ns_per_pixel * large[0] * large[1];
      return { id, label, isTier: tier !== null, time, low: time, high: time, error: error.rmse };
    });
  }

  private async update(): Promise<void> {
    const preset = this.preset();
    this.cancel();
    this.note.textContent = "";
    if (this.checkbox.checked && !this.sweeps.has(preset)) {
      const request = new AbortController();
      this.request = request;
      this.note.textContent = "requesting…";
      try {
        const sweep = await fetchSweep(this.api, preset, ({ stage, progress }) => {
          this.note.textContent = `measuring, ${Math.round(100 * (progress ?? 0))} %${stage === undefined ? "" : `: ${stage}`}`;
        }, request.signal);
        this.sweeps.set(preset, sweep);
      } catch (error) {
        if (request.signal.aborted) return;
        this.checkbox.checked = false;
        this.note.textContent = error instanceof Error ? error.message : String(error);
        return;
      }
    }
    const sweep = this.sweeps.get(preset);
    this.note.textContent = this.checkbox.checked && sweep ? sweep.machine.renderer : "";
    this.changed();
  }
}
