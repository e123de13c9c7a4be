/** Measurements of each preset on this GPU and, on demand, on the server; what of them the view shows. */
import { batch, computed, effect, type Signal, signal } from "@preact/signals";
import { type Api, ApiError, messageOf, type Preset } from "../api";
import type { Viewport } from "../display/viewport";
import { equal } from "../scene/json";
import { DEFAULT_TIER, parseQuality, type Selection, type Store } from "../selection/selection";
import { fetchPoints, fetchSweep, fetchTruth, type JobProgress, type Sweep } from "./api";
import { type BenchmarkInput, QualityBenchmark, qualityRequest } from "./measure/benchmark";
import type { BenchmarkResult, QualityResult } from "./measure/measured";
import type { Choice } from "./measure/budget";
import { type MetricKey, readPicture } from "./measure/errors";
import type { Pixel } from "./pictures/pictures";

/** The benchmark of one preset; kept while the page is open. */
export interface BenchmarkRun {
  input: BenchmarkInput;
  result: BenchmarkResult;
  stopReason: string | null; // Why it ended early; null if it did not
  seconds: number;
}

export class Session {
  readonly selection: Signal<Selection>;
  readonly open = signal(false);
  readonly metric = signal<MetricKey>("rmse");
  readonly curve = signal(""); // Pointer of the setting whose curve is emphasised; empty: none
  readonly highlighted = signal<string | null>(null); // Id of the quality under the pointer or with focus
  readonly choice = signal<Choice | null>(null); // What the budget chose; null before one is set
  /** The pixel under the loupe; null: where the standard quality is worst. It stays while qualities change. */
  readonly loupe = signal<Pixel | null>(null);
  readonly progress = signal<{ share: number | null; step: string } | null>(null);
  readonly withServer = signal(false);
  readonly serverNote = signal("");

  private readonly changes = signal(0); // Counts changes of the maps by preset, which are changed in place
  private readonly runs = new Map<string, BenchmarkRun>();
  private readonly sweeps = new Map<string, Sweep>();
  private readonly failures = new Map<string, string>();
  private running: { preset: string; abort: AbortController } | null = null;
  private request: AbortController | null = null;
  private changeScheduled = false;

  readonly run = computed(() => {
    const run = this.own(this.runs);
    // A copy, since what is measured grows in place and signals compare identities.
    return run && { ...run };
  });
  readonly sweep = computed(() => (this.withServer.value ? this.own(this.sweeps) : null));
  readonly busy = computed(() => this.progress.value !== null);
  readonly failed = computed(() => this.own(this.failures));
  /** The result of the quality that the page runs. */
  readonly current = computed((): QualityResult | null => {
    const run = this.run.value;
    if (run === null) return null;
    const quality = parseQuality(this.selection.value.quality);
    return run.result.measured.find(({ point }) => equal(qualityRequest(point, run.input.standard), quality)) ?? null;
  });
  readonly standard = computed((): QualityResult | null => {
    const run = this.run.value;
    return run?.result.measured.find(({ point }) => point === run.input.standard) ?? run?.result.measured[0] ?? null;
  });

  constructor(
    private readonly api: Api,
    private readonly store: Store,
    readonly viewport: Viewport,
    private readonly selectQuality: (quality: string) => void,
  ) {
    this.selection = signal(store.now);
    store.onChange((now) => (this.selection.value = now));
    let shown: string | null = null;
    effect(() => {
      const name = this.open.value ? this.selection.value.preset.name : null;
      if (name === shown) return;
      shown = name;
      if (name !== null) this.showPreset();
      else {
        this.running?.abort.abort();
        this.request?.abort();
      }
    });
  }

  /** What a map has of the current preset. */
  private own<T>(map: ReadonlyMap<string, T>): T | null {
    return this.changes.value < 0 ? null : (map.get(this.selection.value.preset.name) ?? null);
  }

  select(id: string): void {
    this.choice.value = null;
    const run = this.run.peek();
    const measured = run?.result.measured.find(({ point }) => point.id === id);
    if (!run || !measured || measured === this.current.peek()) return;
    const quality = qualityRequest(measured.point, run.input.standard);
    this.selectQuality(typeof quality === "string" ? quality : JSON.stringify(quality));
  }

  /** Measures the current preset, or cancels the measurement. */
  toggleMeasuring(): void {
    if (this.running) this.running.abort.abort();
    else void this.measure(this.store.now.preset);
  }

  async showServer(shown: boolean): Promise<void> {
    const preset = this.store.now.preset.name;
    this.request?.abort();
    batch(() => {
      this.withServer.value = shown;
      this.serverNote.value = "";
    });
    if (!shown || this.sweeps.has(preset)) return;
    const request = new AbortController();
    this.request = request;
    this.serverNote.value = "requesting…";
    const onProgress = ({ stage, progress }: JobProgress) => {
      this.serverNote.value = `measuring, ${Math.round(100 * (progress ?? 0))} %${stage === undefined ? "" : `: ${stage}`}`;
    };
    try {
      this.sweeps.set(preset, await fetchSweep(this.api, preset, onProgress, request.signal));
      this.serverNote.value = "";
      this.changed();
    } catch (error) {
      if (request.signal.aborted) return;
      this.withServer.value = false;
      this.serverNote.value = messageOf(error);
    }
  }

  /** Shows the results of the current preset, measuring it first if there are none. */
  private showPreset(): void {
    const { preset } = this.store.now;
    if (this.running && this.running.preset !== preset.name) this.running.abort.abort();
    this.request?.abort();
    batch(() => {
      this.highlighted.value = null;
      this.choice.value = null;
      this.curve.value = "";
      this.loupe.value = null;
      this.withServer.value = this.sweeps.has(preset.name);
      this.serverNote.value = "";
    });
    if (!this.runs.has(preset.name)) void this.measure(preset);
  }

  private async measure(preset: Preset): Promise<void> {
    this.running?.abort.abort();
    const abort = new AbortController();
    const running = { preset: preset.name, abort };
    this.running = running;
    this.failures.delete(preset.name);
    this.runs.delete(preset.name);
    this.progress.value = { share: null, step: "Requesting the list of qualities…" };
    this.changed();
    let run: BenchmarkRun | null = null;
    let start = performance.now();
    try {
      const input = await this.loadInput(preset, abort.signal);
      const onProgress = (share: number, step: string) => {
        this.progress.value = { share, step };
        this.scheduleChange();
      };
      const benchmark = new QualityBenchmark(this.api, this.viewport, input, onProgress, abort.signal);
      run = { input, result: benchmark.result, stopReason: null, seconds: 0 };
      this.runs.set(preset.name, run);
      start = performance.now();
      await benchmark.run();
    } catch (error) {
      const notFound = error instanceof ApiError && error.status === 404;
      const message = abort.signal.aborted ? "Cancelled." : messageOf(error);
      if (run) run.stopReason = message;
      else this.failures.set(preset.name, notFound ? "The server does not support the accuracy benchmark." : message);
    }
    if (run) this.finish(preset, run, (performance.now() - start) / 1000);
    if (this.running === running) {
      this.running = null;
      this.progress.value = null;
    }
    this.changed();
  }

  private finish(preset: Preset, run: BenchmarkRun, seconds: number): void {
    run.seconds = seconds;
    if (run.result.measured.length > 0) return;
    // Without results the preset is measured again when it is shown next.
    this.runs.delete(preset.name);
    this.failures.set(preset.name, run.stopReason ?? "No quality could be measured.");
  }

  private async loadInput(preset: Preset, abort: AbortSignal): Promise<BenchmarkInput> {
    const { points, truth: info } = await fetchPoints(this.api, preset.name, abort);
    // Other qualities are compared with it.
    const standard = points.find(({ tier }) => tier === DEFAULT_TIER) ?? points[0];
    if (standard === undefined) throw new Error("The server lists no quality to measure.");
    const onProgress = (progress: JobProgress) => {
      this.progress.value = { share: progress.progress ?? null, step: referenceProgress(progress) };
    };
    const truth = readPicture(await fetchTruth(this.api, info, preset.name, onProgress, abort));
    return { preset, points, standard, truth, info: { ...info, width: truth.width, height: truth.height } };
  }

  private changed(): void {
    this.changes.value = this.changes.peek() + 1;
  }

  private scheduleChange(): void {
    if (this.changeScheduled) return;
    this.changeScheduled = true;
    requestAnimationFrame(() => {
      this.changeScheduled = false;
      this.changed();
    });
  }
}

function referenceProgress({ progress, eta_s: eta }: JobProgress): string {
  const share = progress === undefined || progress === 0 ? "" : ` ${Math.round(100 * progress)} %`;
  return `Computing the float64 reference…${share}${typeof eta === "number" ? `, ${Math.ceil(eta)} s left` : ""}`;
}
