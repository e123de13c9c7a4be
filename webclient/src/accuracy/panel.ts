/** Accuracy benchmark panel: measures time and error of every quality on this GPU. */
import "./style.css";
import { type Api, ApiError, type Preset } from "../api";
import { parseQuality } from "../app/quality";
import type { Store } from "../app/store";
import type { Viewport } from "../app/viewport";
import { equal } from "../scene/json";
import { element } from "../ui/dom";
import { icon } from "../ui/icons";
import { fetchPoints, fetchTruth, type JobProgress } from "./api";
import { type BenchmarkInput, type BenchmarkResult, QualityBenchmark, qualityRequest, type QualityResult } from "./benchmark";
import { BudgetForm } from "./budgetform";
import { Chart, type Mark } from "./chart";
import { ErrorView } from "./errorview";
import { readPicture } from "./npy";
import { costOf, ResultSections } from "./results";
import { ServerMeasurement } from "./servermeasurement";
import { quantile } from "./statistics";

/** The tier that other qualities are compared with. */
const STANDARD_TIER = "standard";

export interface AccuracyEvents {
  /** `quality`: a tier, or settings as JSON. */
  selectQuality(quality: string): void;
  close(): void;
}

/** The benchmark of one preset; kept while the page is open. */
interface BenchmarkRun {
  input: BenchmarkInput;
  result: BenchmarkResult;
  /** Why it ended early; null if it did not. */
  stopReason: string | null;
  seconds: number;
}

export class AccuracyPanel {
  private readonly root = element("aside", { id: "accuracy", "aria-label": "Accuracy benchmark", tabindex: -1 });
  private readonly lead = element("p", { class: "lead" });
  private readonly editedNote = element("p", { class: "edited", hidden: true });
  private readonly status = element("span", { role: "status" });
  private readonly progress = element("progress", { max: 1, "aria-label": "Benchmark progress" });
  private readonly runButton = element("button", { type: "button", class: "small" });
  private readonly chart = new Chart({
    select: (id) => this.select(id),
    highlight: (id) => this.sections.highlight(id),
  });
  private readonly sections = new ResultSections((id) => this.select(id));
  private readonly errorView = new ErrorView();
  private readonly serverMeasurement: ServerMeasurement;
  private readonly budgetForm: BudgetForm;
  private readonly finePrint = element("p", { class: "fine" });
  private readonly results = element("div", { hidden: true });

  /** By preset. */
  private readonly runs = new Map<string, BenchmarkRun>();
  private running: { preset: string; abort: AbortController } | null = null;
  private failure: { preset: string; message: string } | null = null;
  private open = false;
  private renderScheduled = false;

  constructor(
    private readonly api: Api,
    private readonly store: Store,
    private readonly viewport: Viewport,
    private readonly events: AccuracyEvents,
  ) {
    this.serverMeasurement = new ServerMeasurement(api, () => store.now.preset.name, () => this.render());
    this.budgetForm = new BudgetForm(viewport, () => this.run?.result ?? null, (id) => this.select(id));
    const close = element("button", { type: "button", class: "plain", "aria-label": "Close accuracy benchmark" }, icon("close"));
    close.addEventListener("click", () => events.close());
    this.root.addEventListener("keydown", (event) => {
      if (event.key === "Escape") events.close();
    });
    this.runButton.addEventListener("click", () => {
      if (this.running) this.running.abort.abort();
      else void this.measure(this.store.now.preset);
    });
    const { sections, budgetForm } = this;
    this.results.append(this.serverMeasurement.root, sections.selected, budgetForm.root, budgetForm.message, this.errorView.root, ...sections.details);
    this.root.append(
      element("div", { class: "head" }, element("h2", {}, "Accuracy benchmark"), close),
      element(
        "div",
        { class: "body" },
        this.lead,
        this.editedNote,
        element("div", { class: "measuring" }, this.status, this.runButton, this.progress),
        this.chart.root,
        this.results,
        this.finePrint,
      ),
    );
    this.root.inert = true;
    document.getElementById("settings")?.after(this.root);
    store.onChange((now, before) => {
      if (!this.open) return;
      if (now.preset.name !== before.preset.name) this.showPreset();
      else if (now.quality !== before.quality || now.scene !== before.scene) this.render();
    });
  }

  toggle(open: boolean, focus: boolean): void {
    if (open === this.open) return;
    this.open = open;
    const hadFocus = this.root.contains(document.activeElement);
    // A layout while closed, so that opening is animated.
    this.root.getBoundingClientRect();
    this.root.classList.toggle("open", open);
    this.root.inert = !open;
    document.body.classList.toggle("accuracy-open", open);
    if (open) {
      if (focus) this.root.focus({ preventScroll: true });
      this.showPreset();
      return;
    }
    this.running?.abort.abort();
    this.serverMeasurement.cancel();
    if (hadFocus) document.querySelector<HTMLElement>("#tools [data-tool=accuracy]")?.focus();
  }

  /** Shows the results of the current preset, measuring it first if there are none. */
  private showPreset(): void {
    const { preset } = this.store.now;
    if (this.running && this.running.preset !== preset.name) this.running.abort.abort();
    this.sections.highlight(null);
    this.budgetForm.message.textContent = "";
    this.serverMeasurement.reset();
    this.render();
    if (!this.runs.has(preset.name)) void this.measure(preset);
  }

  private async measure(preset: Preset): Promise<void> {
    this.running?.abort.abort();
    const abort = new AbortController();
    const running = { preset: preset.name, abort };
    this.running = running;
    this.failure = null;
    this.runs.delete(preset.name);
    this.showProgress(null, "Requesting the list of qualities…");
    this.render();
    let run: BenchmarkRun | null = null;
    let start = performance.now();
    try {
      const input = await this.loadInput(preset, abort.signal);
      const onProgress = (share: number, step: string) => {
        this.showProgress(share, step);
        this.scheduleRender();
      };
      const benchmark = new QualityBenchmark(this.api, this.viewport, input, onProgress, abort.signal);
      run = { input, result: benchmark.result, stopReason: null, seconds: 0 };
      this.runs.set(preset.name, run);
      start = performance.now();
      await benchmark.run();
    } catch (error) {
      const notFound = error instanceof ApiError && error.status === 404;
      const message = abort.signal.aborted ? "Cancelled." : error instanceof Error ? error.message : String(error);
      if (run) run.stopReason = message;
      else this.failure = { preset: preset.name, message: notFound ? "The server does not support the accuracy benchmark." : message };
    }
    if (run) {
      run.seconds = (performance.now() - start) / 1000;
      // Without results the preset is measured again when it is shown next.
      if (run.result.measured.length === 0) {
        this.runs.delete(preset.name);
        this.failure = { preset: preset.name, message: run.stopReason ?? "No quality could be measured." };
      }
    }
    if (this.running === running) this.running = null;
    if (this.open) this.render();
  }

  private async loadInput(preset: Preset, signal: AbortSignal): Promise<BenchmarkInput> {
    const { points, truth: info } = await fetchPoints(this.api, preset.name, signal);
    const standard = points.find(({ tier }) => tier === STANDARD_TIER) ?? points[0];
    if (standard === undefined) throw new Error("The server lists no quality to measure.");
    const onProgress = (progress: JobProgress) => this.showProgress(progress.progress ?? null, referenceProgress(progress));
    const truth = readPicture(await fetchTruth(this.api, info, preset.name, onProgress, signal));
    return { preset, points, standard, truth, info: { ...info, width: truth.width, height: truth.height } };
  }

  private showProgress(share: number | null, step: string): void {
    this.status.textContent = step;
    if (share === null) this.progress.removeAttribute("value");
    else this.progress.value = share;
  }

  private scheduleRender(): void {
    if (this.renderScheduled) return;
    this.renderScheduled = true;
    requestAnimationFrame(() => {
      this.renderScheduled = false;
      if (this.open) this.render();
    });
  }

  private get run(): BenchmarkRun | null {
    return this.runs.get(this.store.now.preset.name) ?? null;
  }

  /** The result of the quality that the page runs. */
  private currentResult({ input, result }: BenchmarkRun): QualityResult | null {
    const quality = parseQuality(this.store.now.quality);
    return result.measured.find(({ point }) => equal(qualityRequest(point, input.standard), quality)) ?? null;
  }

  private select(id: string): void {
    const { run } = this;
    const measured = run?.result.measured.find(({ point }) => point.id === id);
    if (!run || !measured) return;
    const quality = qualityRequest(measured.point, run.input.standard);
    this.budgetForm.message.textContent = "";
    this.events.selectQuality(typeof quality === "string" ? quality : JSON.stringify(quality));
  }

  private render(): void {
    const { preset, scene } = this.store.now;
    const { run } = this;
    const busy = this.running !== null;
    const failure = this.failure?.preset === preset.name ? this.failure.message : null;
    const name = element("b", {}, preset.title);
    this.lead.replaceChildren("Renders ", name, " at every quality on this GPU and compares each picture with a converged float64 reference.");
    this.editedNote.hidden = equal(scene, preset.scene);
    this.editedNote.textContent = `The scene was edited. References exist for presets only: the benchmark measures ${preset.title} unedited.`;
    this.progress.hidden = !busy;
    this.runButton.textContent = busy ? "Cancel" : "Measure again";
    if (!busy) this.status.textContent = failure ?? (run ? summary(run) : "");
    this.status.classList.toggle("failed", failure !== null && !busy);

    const measured = run?.result.measured ?? [];
    const current = run && this.currentResult(run);
    const hasResults = measured.length > 0;
    this.results.hidden = !hasResults;
    this.finePrint.hidden = !hasResults;
    this.serverMeasurement.root.hidden = busy;
    this.budgetForm.root.hidden = busy;
    this.chart.root.classList.toggle("empty", !hasResults);
    this.chart.show({
      marks: measured.map(markOf),
      server: run ? this.serverMeasurement.marks(run.result) : [],
      current: current?.point.id ?? null,
    });
    const standard = measured.find(({ point }) => point === run?.input.standard) ?? measured[0];
    if (!run || standard === undefined) return;
    this.sections.show(run.result, standard, current);
    this.errorView.show(current ?? standard, standard, run.input.truth);
    this.finePrint.textContent = methodNote(run, this.viewport.gpu.capabilities.renderer);
  }
}

function markOf(result: QualityResult): Mark {
  const { point, rounds } = result;
  return { ...costOf(result), label: point.label, isTier: point.tier !== null, low: quantile(rounds, 0.25), high: quantile(rounds, 0.75) };
}

function referenceProgress({ progress, eta_s: eta }: JobProgress): string {
  const share = progress === undefined || progress === 0 ? "" : ` ${Math.round(100 * progress)} %`;
  return `Computing the float64 reference…${share}${typeof eta === "number" ? `, ${Math.ceil(eta)} s left` : ""}`;
}

function summary({ result, input, stopReason, seconds }: BenchmarkRun): string {
  const count = result.measured.length;
  if (stopReason === null) return `${count} qualities measured in ${Math.round(seconds)} s`;
  return `${stopReason} ${count} of ${input.points.length} qualities measured`;
}

function methodNote({ result, input: { info } }: BenchmarkRun, renderer: string): string {
  const { large } = result.sizes;
  const clock = result.byGpu ? "GPU timer queries" : "wall clock until a pixel is read back";
  return (
    `${renderer}. Times: medians of ${result.rounds} interleaved rounds at ${large[0]} × ${large[1]}, ${clock}. ` +
    `Errors: linear light clipped at white, ${info.width} × ${info.height}, t = ${info.time} s, reference with ${info.samples} float64 samples a pixel.`
  );
}
