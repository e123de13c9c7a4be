/** Accuracy benchmark panel: time and error of every quality on this GPU. */
import type { Signal } from "@preact/signals";
import { render } from "preact";
import { useMemo } from "preact/hooks";
import type { Api } from "../api";
import { logAxis } from "../charts/axis";
import type { Axes } from "../charts/linechart";
import type { Viewport } from "../display/viewport";
import { equal } from "../scene/json";
import type { Store } from "../selection/selection";
import { Progress, Select } from "../ui/controls";
import { download, element } from "../ui/dom";
import { drawerHead, slide } from "../ui/overlays";
import { curvesOf } from "./diagram/curves";
import { Diagram } from "./diagram/diagram";
import { METRICS } from "./measure/errors";
import { type ExportedRun, type Measured, measuredHere, measuredThere, ranked, rowsOf, toCsv, toJson } from "./measure/measured";
import { ErrorView, InsetsView, SpectrumView } from "./pictures/views";
import { AllQualities, Benefits, BudgetForm, Passes, QUIET, Selected } from "./sections";
import { type BenchmarkRun, Session } from "./session";

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

const KEY = "mr-1 mb-1 inline-block w-4";

export function View({ session }: { session: Session }) {
  const { preset, scene } = session.selection.value;
  const run = session.run.value;
  const hasResults = (run?.result.measured.length ?? 0) > 0;
  return (
    <>
      <p class="text-soft">
        Renders <b class="font-medium text-ink">{preset.title}</b> at every quality on this GPU and compares each picture with a converged float64 reference.
      </p>
      {!equal(scene, preset.scene) && (
        <p class="edited text-fine text-accent">The scene was edited. References exist for presets only: the benchmark measures {preset.title} unedited.</p>
      )}
      <Measuring session={session} />
      <Diagrams session={session} run={run} />
      {run && hasResults && <Results session={session} run={run} />}
    </>
  );
}

function Measuring({ session }: { session: Session }) {
  const progress = session.progress.value;
  const failure = session.failed.value;
  const run = session.run.value;
  return (
    <div class="grid min-h-11 grid-cols-[1fr_auto] items-center text-fine">
      <span role="status" class={failure !== null && progress === null ? "text-error" : ""}>
        {progress?.step ?? failure ?? (run ? summary(run) : "")}
      </span>
      <button type="button" class={QUIET} onClick={() => session.toggleMeasuring()}>
        {progress ? "Cancel" : "Measure again"}
      </button>
      {progress && <Progress class="col-span-full" label="Benchmark progress" share={progress.share} />}
    </div>
  );
}

function Diagrams({ session, run }: { session: Session; run: BenchmarkRun | null }) {
  const metric = session.metric.value;
  const sweep = session.sweep.value;
  const { here, there, curves, axes } = useMemo(() => {
    const marksOf = (measured: Measured[] = []) => ranked(measured, metric).sort((a, b) => a.time - b.time);
    const marks = { here: marksOf(run?.result.measured.map(measuredHere)), there: marksOf(run && sweep ? measuredThere(sweep, run.result) : []) };
    const times = new Map(marks.here.map(({ id, time }) => [id, time]));
    const time = (id: string) => times.get(id) ?? Infinity;
    const both = [...marks.here, ...marks.there];
    const { label, unit } = METRICS.find(({ key }) => key === metric) ?? METRICS[0];
    const shared: Axes = {
      x: logAxis(both.flatMap(({ low, time: middle, high }) => [low, middle, high])),
      y: logAxis(both.map(({ error }) => error)),
      xLabel: "frame time, ms",
      yLabel: `${label}, ${unit}`,
    };
    return { ...marks, axes: shared, curves: run ? curvesOf(run.input.points, run.input.standard, time) : [] };
  }, [run, sweep, metric]);
  const common = { curves, axes, session, fitting: session.choice.value?.fitting ?? null };
  return (
    <>
      <div class="flex gap-4 text-soft">
        <Choice name="Error" value={session.metric} options={METRICS.map(({ key, label }) => [key, label] as const)} />
        <Choice name="Setting" value={session.curve} options={[["", "all"], ...curves.map(({ pointer, title }) => [pointer, title] as const)]} />
      </div>
      <div class={sweep ? "grid grid-cols-2 gap-3 phone:grid-cols-1" : ""}>
        <Diagram kind="machine" title="Frame time and error of every quality" caption="This machine" marks={here} {...common} />
        {sweep && (
          <Diagram kind="server" title="Frame time and error on the server" caption={`The server: ${sweep.machine.renderer}`} marks={there} {...common} fitting={null} />
        )}
      </div>
      <p class="text-fine text-dim">
        <i class={`${KEY} border-t-2 border-accent`} /> tiers <i class={`${KEY} ml-2 border-t border-dashed border-soft`} /> Pareto front <i class={`${KEY} ml-2 border-t border-teal`} /> one setting changed, bars from first to third quartile
      </p>
      {run && !session.busy.value && <ServerSwitch session={session} />}
    </>
  );
}

function Choice<T extends string>({ name, value, options }: { name: string; value: Signal<T>; options: readonly (readonly [T, string])[] }) {
  return (
    <label class="flex min-w-0 items-center">
      <span aria-hidden="true">{name}</span>
      <Select class="pick min-w-0 text-ink" label={name} value={value.value} options={options} choose={(chosen) => (value.value = chosen)} />
    </label>
  );
}

function ServerSwitch({ session }: { session: Session }) {
  return (
    <label class="server-switch flex min-h-11 items-center gap-2.5 text-soft">
      <input type="checkbox" class="size-4.5 accent-accent" checked={session.withServer.value} onChange={(event) => void session.showServer(event.currentTarget.checked)} />
      <span>Server measurement beside it <span class="text-fine text-dim">{session.serverNote.value}</span></span>
    </label>
  );
}

function Results({ session, run }: { session: Session; run: BenchmarkRun }) {
  const standard = session.standard.value;
  if (standard === null) return null;
  const current = session.current.value;
  const shown = current ?? standard;
  const { truth } = run.input;
  return (
    <>
      <Selected shown={shown} standard={standard} isCurrent={current !== null} />
      {!session.busy.value && <BudgetForm session={session} run={run} />}
      <InsetsView session={session} run={run} shown={shown} standard={standard} />
      <ErrorView shown={shown} standard={standard} truth={truth} />
      <SpectrumView shown={shown} standard={standard} truth={truth} />
      <Passes {...shown} />
      <Benefits standard={standard} measured={run.result.measured} session={session} />
      <AllQualities run={run} session={session} />
      <Downloads session={session} run={run} />
      <p class="border-t border-line py-3 text-fine text-dim">{methodNote(run, session.viewport.gpu.capabilities.renderer)}</p>
    </>
  );
}

function Downloads({ session, run }: { session: Session; run: BenchmarkRun }) {
  const shown = (): ExportedRun => {
    const [width, height] = run.result.sizes.large;
    const { renderer } = session.viewport.gpu.capabilities;
    const sweep = session.sweep.value;
    const server = sweep ? rowsOf(measuredThere(sweep, run.result), `server: ${sweep.machine.renderer}`) : [];
    const rows = [...rowsOf(run.result.measured.map(measuredHere), `this machine: ${renderer}`), ...server];
    return { preset: run.input.preset.name, width, height, method: methodNote(run, renderer), rows };
  };
  const formats = [{ name: "csv", type: "text/csv", text: toCsv }, { name: "json", type: "application/json", text: toJson }];
  return (
    <div class="grid grid-cols-2 gap-2 border-t border-line pt-2.5 pb-1">
      {formats.map(({ name, type, text }) => (
        <button type="button" class="button" key={name} onClick={() => download(new Blob([text(shown())], { type }), `seafoam-accuracy-${run.input.preset.name}.${name}`)}>
          Download {name.toUpperCase()}
        </button>
      ))}
    </div>
  );
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
    `Errors: linear light clipped at white, ${info.width} × ${info.height}, t = ${info.time} s, reference with ${info.samples} float64 samples a pixel; ` +
    "FLIP: displayed pictures without glare, 67 pixels a degree."
  );
}
