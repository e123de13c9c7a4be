/** What accuracy costs, measured on the visitor's own GPU: the panel, and what it runs. */
import "./style.css";
import { type Api, ApiError, type Preset } from "../api";
import { qualityOf } from "../app/quality";
import type { Stage } from "../app/stage";
import type { Store } from "../app/store";
import { labelOf } from "../panel/model";
import { equal } from "../scene/json";
import { element } from "../ui/dom";
import { icon } from "../ui/icons";
import { pointsOf, type Running, type Sweep, sweepOf, truthOf } from "./api";
import { Chart, type Mark } from "./chart";
import { Compared } from "./compared";
import { compare, front, median, model, pick, quantile, short } from "./compare";
import { NOTHING, worths } from "./knobs";
import { asked, type Measured, Measuring, type Result, type Subject } from "./measure";
import { readPicture } from "./npy";

/** The tier that every other quality is held against. */
const COMMON = "standard";
/** A frame of a screen that shows sixty a second, ms. */
const BUDGET = 16;

export interface ViewEvents {
  /** The page is to run this quality: a tier, or knobs as JSON. */
  run(quality: string): void;
  close(): void;
}

/** What is known of one preset; kept while the page is open. */
interface Known {
  subject: Subject;
  result: Result;
  /** Why there is not all of it. */
  stopped: string | null;
  seconds: number;
}

export class AccuracyView {
  private readonly root = element("aside", { id: "accuracy", "aria-label": "What accuracy costs", tabindex: -1 });
  private readonly lead = element("p", { class: "lead" });
  private readonly note = element("p", { class: "changed", hidden: true });
  private readonly status = element("span", { role: "status" });
  private readonly bar = element("progress", { max: 1, "aria-label": "Progress of the measurement" });
  private readonly action = element("button", { type: "button", class: "small" });
  private readonly chart = new Chart({
    choose: (id) => this.choose(id),
    look: (id) => this.look(id),
  });
  private readonly serverBox = element("input", { type: "checkbox" });
  private readonly serverNote = element("span", { class: "fine" });
  private readonly serverRow = element(
    "label",
    { class: "server" },
    this.serverBox,
    element("span", {}, element("i", {}), "the server’s own measurement ", this.serverNote),
  );
  private readonly chosen = element("section", { class: "chosen", "aria-live": "polite" });
  private readonly budget = element("input", { type: "number", inputmode: "decimal", id: "budget", min: 0.01, step: "any", value: BUDGET });
  private readonly picked = element("p", { class: "picked", role: "status" });
  private readonly budgetForm = element(
    "form",
    { class: "budget" },
    element("label", { for: "budget" }, "Frame budget"),
    element("span", { class: "field" }, this.budget, element("span", {}, "ms")),
    element("button", { type: "submit", class: "primary" }, "Find the best"),
  );
  private readonly compared = new Compared();
  private readonly passes = details("Where the time goes");
  private readonly worth = details("What each knob is worth");
  private readonly table = details("Every quality in numbers");
  private readonly fine = element("p", { class: "fine" });
  /** What needs numbers to show. */
  private readonly found = element("div", { class: "found", hidden: true });

  private readonly known = new Map<string, Known>();
  private readonly sweeps = new Map<string, Sweep>();
  private running: { preset: string; cancel: AbortController } | null = null;
  private asking: AbortController | null = null;
  private open = false;
  private looked: string | null = null;
  private failure: { preset: string; why: string } | null = null;
  private drawn = false;

  constructor(
    private readonly api: Api,
    private readonly store: Store,
    private readonly stage: Stage,
    private readonly events: ViewEvents,
  ) {
    const close = element("button", { type: "button", class: "plain", "aria-label": "Close what accuracy costs" }, icon("close"));
    close.addEventListener("click", () => events.close());
    this.root.addEventListener("keydown", (event) => {
      if (event.key === "Escape") events.close();
    });
    this.action.addEventListener("click", () => {
      if (this.running) this.running.cancel.abort();
      else void this.measure(this.store.now.preset);
    });
    this.serverBox.addEventListener("change", () => void this.askServer());
    this.budgetForm.addEventListener("submit", (event) => {
      event.preventDefault();
      this.fit();
    });
    this.found.append(this.serverRow, this.chosen, this.budgetForm, this.picked, this.compared.root, this.passes.root, this.worth.root, this.table.root);
    this.worth.root.open = true;
    this.root.append(
      element("div", { class: "head" }, element("h2", {}, "What accuracy costs"), close),
      element(
        "div",
        { class: "body" },
        this.lead,
        this.note,
        element("div", { class: "measuring" }, this.status, this.action, this.bar),
        this.chart.root,
        this.found,
        this.fine,
      ),
    );
    this.root.inert = true;
    document.getElementById("settings")?.after(this.root);
    store.onChange((now, before) => {
      if (!this.open) return;
      if (now.preset.name !== before.preset.name) this.turn();
      else if (now.quality !== before.quality || now.scene !== before.scene) this.render();
    });
  }

  toggle(open: boolean, focus: boolean): void {
    if (open === this.open) return;
    this.open = open;
    const focused = this.root.contains(document.activeElement);
    // Once in the page, so that what is closed is seen to move in.
    this.root.getBoundingClientRect();
    this.root.classList.toggle("open", open);
    this.root.inert = !open;
    document.body.classList.toggle("accuracy-open", open);
    if (open) {
      if (focus) this.root.focus({ preventScroll: true });
      this.turn();
      return;
    }
    this.running?.cancel.abort();
    this.asking?.abort();
    if (focused) document.querySelector<HTMLElement>("#tools [data-tool=accuracy]")?.focus();
  }

  /** Turns to the preset that the page shows: to what is known of it, or measures it. */
  private turn(): void {
    const { preset } = this.store.now;
    if (this.running && this.running.preset !== preset.name) this.running.cancel.abort();
    this.looked = null;
    this.picked.textContent = "";
    this.serverBox.checked = this.sweeps.has(preset.name);
    this.serverNote.textContent = "";
    this.asking?.abort();
    this.render();
    if (!this.known.has(preset.name)) void this.measure(preset);
  }

  private async measure(preset: Preset): Promise<void> {
    this.running?.cancel.abort();
    const cancel = new AbortController();
    const running = { preset: preset.name, cancel };
    this.running = running;
    this.failure = null;
    this.known.delete(preset.name);
    const { signal } = cancel;
    let began = performance.now();
    let known: Known | null = null;
    this.tell(null, "Asking what there is to measure…");
    this.render();
    try {
      const { points, truth: info } = await pointsOf(this.api, preset.name, signal);
      const standard = points.find(({ tier }) => tier === COMMON) ?? points[0];
      if (standard === undefined) throw new Error("The server names no quality to measure.");
      const bytes = await truthOf(this.api, info, preset.name, (said) => this.tell(said.progress ?? null, truthWords(said)), signal);
      const truth = readPicture(bytes);
      const subject: Subject = { preset, points, standard, truth, info: { ...info, width: truth.width, height: truth.height } };
      const measuring = new Measuring(this.api, this.stage, subject, (share, what) => {
        this.tell(share, what);
        this.later();
      }, signal);
      known = { subject, result: measuring.result, stopped: null, seconds: 0 };
      this.known.set(preset.name, known);
      began = performance.now();
      await measuring.run();
    } catch (error) {
      const why = signal.aborted ? "Stopped." : error instanceof Error ? error.message : String(error);
      if (known) known.stopped = why;
      else this.failure = { preset: preset.name, why: error instanceof ApiError && error.status === 404 ? "This server does not measure the cost of accuracy." : why };
    }
    // What was called off before it knew anything, such as by another preset, is measured when it is asked for again.
    if (known) {
      known.seconds = (performance.now() - began) / 1000;
      if (known.result.measured.length === 0) {
        this.known.delete(preset.name);
        this.failure = { preset: preset.name, why: known.stopped ?? "Nothing could be measured." };
      }
    }
    if (this.running === running) this.running = null;
    if (this.open) this.render();
  }

  private tell(share: number | null, what: string): void {
    this.status.textContent = what;
    if (share === null) this.bar.removeAttribute("value");
    else this.bar.value = share;
  }

  /** Shows what came in since, once a frame. */
  private later(): void {
    if (this.drawn) return;
    this.drawn = true;
    requestAnimationFrame(() => {
      this.drawn = false;
      if (this.open) this.render();
    });
  }

  private get now(): Known | null {
    return this.known.get(this.store.now.preset.name) ?? null;
  }

  /** The point that the page runs. */
  private current(known: Known): Measured | null {
    const quality = qualityOf(this.store.now.quality);
    return known.result.measured.find(({ point }) => equal(asked(point, known.subject.standard), quality)) ?? null;
  }

  private choose(id: string): void {
    const { now } = this;
    const measured = now?.result.measured.find(({ point }) => point.id === id);
    if (!now || !measured) return;
    const quality = asked(measured.point, now.subject.standard);
    this.picked.textContent = "";
    this.events.run(typeof quality === "string" ? quality : JSON.stringify(quality));
  }

  private look(id: string | null): void {
    this.looked = id;
    for (const row of this.table.body.querySelectorAll("tr")) row.classList.toggle("looked", id !== null && row.dataset["id"] === id);
  }

  private render(): void {
    const { preset, scene } = this.store.now;
    const { now } = this;
    const busy = this.running !== null;
    const failure = this.failure?.preset === preset.name ? this.failure.why : null;
    this.lead.replaceChildren("Every quality of ", element("b", {}, preset.title), ", drawn by your GPU and held against a converged float64 picture of the same moment.");
    this.note.hidden = equal(scene, preset.scene);
    this.note.textContent = `The sea was changed. There is a true picture of presets only, so this measures ${preset.title} as it comes.`;
    this.bar.hidden = !busy;
    this.action.textContent = busy ? "Cancel" : "Measure again";
    if (!busy) this.status.textContent = failure ?? (now ? summary(now) : "");
    this.status.classList.toggle("failed", failure !== null && !busy);

    const measured = now?.result.measured ?? [];
    const ready = now !== null && measured.length > 0;
    this.found.hidden = !ready;
    this.fine.hidden = !ready;
    this.serverRow.hidden = busy;
    this.budgetForm.hidden = busy;
    const current = now && this.current(now);
    this.chart.root.classList.toggle("empty", !ready);
    this.chart.show({
      marks: now ? measured.map((each) => mark(each)) : [],
      server: now && this.serverBox.checked ? this.serverMarks(now) : [],
      current: current?.point.id ?? null,
    });
    if (!now || !ready) return;
    const standard = measured.find(({ point }) => point === now.subject.standard) ?? measured[0];
    if (standard === undefined) return;
    const focus = current ?? standard;
    this.showChosen(focus, standard, current === null);
    this.compared.show(focus, standard, now.subject.truth);
    this.showPasses(focus);
    this.showWorth(standard, measured);
    this.showTable(now, current);
    this.fine.textContent = fineprint(now, this.stage.gpu.capabilities.renderer);
  }

  private showChosen({ point, errors, rounds }: Measured, standard: Measured, foreign: boolean): void {
    const same = point === standard.point;
    const { words } = compare(standard.rounds, rounds, standard.errors.rmse, errors.rmse);
    const sentence = same ? "What every other quality is held against." : `Against ${standard.point.label}: ${words}.`;
    const figure = (value: string, unit: string, name: string) =>
      element("div", {}, element("dt", {}, name), element("dd", {}, element("b", {}, value), " ", unit));
    const contents = [
      element("h3", {}, point.label),
      element("p", { class: "sentence" }, sentence),
      element(
        "dl",
        {},
        figure(short(median(rounds)), "ms", "a frame"),
        figure(short(errors.rmse), "levels", "RMSE"),
        figure(short(errors.max), "levels", "at most"),
        figure((100 * errors.coverage).toFixed(1), "%", "foam coverage"),
      ),
      ...(foreign ? [element("p", { class: "fine" }, "The page runs a quality that is not measured here.")] : []),
    ];
    replace(this.chosen, contents);
  }

  private showPasses({ passes }: Measured): void {
    const total = passes.reduce((sum, { time }) => sum + time, 0);
    this.passes.count.textContent = `${passes.length} ${passes.length === 1 ? "pass" : "passes"}`;
    const items = [...passes]
      .sort((a, b) => b.time - a.time)
      .map(({ name, time }) => {
        const item = element("li", {}, element("span", {}, name), element("span", { class: "number" }, `${short(time)} ms`));
        item.style.setProperty("--share", `${(100 * time) / total}%`);
        return item;
      });
    replace(this.passes.body, [element("ol", { class: "passes" }, ...items)]);
  }

  private showWorth(standard: Measured, measured: readonly Measured[]): void {
    const timed = (each: Measured) => ({ id: each.point.id, point: each.point, time: median(each.rounds), error: each.errors.rmse, rounds: each.rounds });
    const found = worths(timed(standard), measured.map(timed));
    this.worth.count.textContent = "error removed for each added ms";
    const rows = found.map(({ id, title, owner, cause, from, to, added, measurable, removed, perMs }) => {
      const row = element(
        "tr",
        { "data-id": id },
        element(
          "th",
          { scope: "row", title: `${labelOf(owner)}, works on ${cause}` },
          this.pickButton(id, title),
          element("span", { class: "values" }, `${from} → ${to}`),
        ),
        element("td", {}, measurable ? signed(added) : "≈ 0"),
        element("td", {}, signed(removed)),
        element("td", { class: "lead-number" }, perMs === null ? (removed < NOTHING ? "–" : "free") : signed(perMs)),
      );
      if (removed < NOTHING) row.classList.add("vain");
      return row;
    });
    replace(this.worth.body, [table(["knob", "ms added", "error removed", "per ms"], rows)]);
  }

  private showTable(now: Known, current: Measured | null): void {
    const { measured, refused } = now.result;
    const best = new Set(front(measured.map(cost)).map(({ id }) => id));
    this.table.count.textContent = `${measured.length + refused.length}`;
    const rows = [...measured]
      .sort((a, b) => median(a.rounds) - median(b.rounds))
      .map(({ point, rounds, errors }) => {
        const row = element(
          "tr",
          { "data-id": point.id, ...(point === current?.point ? { "aria-current": "true" } : {}) },
          element("th", { scope: "row" }, this.pickButton(point.id, point.label), ...(best.has(point.id) ? [element("span", { class: "values" }, "on the front")] : [])),
          element("td", { title: `quartiles ${short(quantile(rounds, 0.25))} to ${short(quantile(rounds, 0.75))} ms` }, short(median(rounds))),
          element("td", {}, short(errors.rmse)),
          element("td", {}, short(errors.max)),
          element("td", {}, (100 * errors.coverage).toFixed(1)),
        );
        return row;
      });
    rows.push(...refused.map(({ point, why }) => element("tr", { class: "vain" }, element("th", { scope: "row" }, point.label), element("td", { colspan: 4 }, why))));
    replace(this.table.body, [table(["quality", "ms", "RMSE", "max", "foam %"], rows)]);
    this.look(this.looked);
  }

  private pickButton(id: string, label: string): HTMLButtonElement {
    const button = element("button", { type: "button", class: "pick", title: `Run ${label}` }, label);
    button.addEventListener("click", () => this.choose(id));
    return button;
  }

  /** Runs the best quality for the time that the visitor has. */
  private fit(): void {
    const { now } = this;
    const budget = this.budget.valueAsNumber;
    if (!now || !(budget > 0)) return;
    const page = this.stage.timing();
    const [width, height] = [Math.round(page.width / page.scale), Math.round(page.height / page.scale)];
    const { timed, small } = now.result.sizes;
    const predicted = now.result.measured.map((each) => {
      const { fixed, perPixel } = model(median(each.rounds), timed[0] * timed[1], median(each.small), small[0] * small[1]);
      return { ...cost(each), time: fixed + perPixel * width * height, measured: each };
    });
    const best = pick(predicted, budget);
    if (best === null) return;
    const { point, fits, fitting } = best;
    this.choose(point.id);
    const reason = fits
      ? `it has the least error of the ${fitting} that fit, of ${predicted.length} measured`
      : `none of ${predicted.length} fits, and it is the fastest`;
    this.picked.replaceChildren(
      "Runs ",
      element("b", {}, point.measured.point.label),
      `: ${reason}. It should take ${short(point.time)} of ${short(budget)} ms at this window’s ${width} × ${height}, with an error of ${short(point.error)} levels.`,
    );
  }

  private serverMarks(now: Known): Mark[] {
    const { timed } = now.result.sizes;
    return (this.sweeps.get(now.subject.preset.name)?.points ?? []).map(({ id, label, tier, model: at, error }) => {
      const time = at.fixed_ms + 1e-6 * at.ns_per_pixel * timed[0] * timed[1];
      return { id, label, tier: tier !== null, time, low: time, high: time, error: error.rmse };
    });
  }

  /** Asks the server for what it measured, which it does first where it has not. */
  private async askServer(): Promise<void> {
    const { preset } = this.store.now;
    this.asking?.abort();
    this.serverNote.textContent = "";
    if (this.serverBox.checked && !this.sweeps.has(preset.name)) {
      const asking = new AbortController();
      this.asking = asking;
      this.serverNote.textContent = "asking…";
      try {
        const sweep = await sweepOf(this.api, preset.name, ({ stage, progress }) => {
          this.serverNote.textContent = `measuring, ${Math.round(100 * (progress ?? 0))} %${stage === undefined ? "" : `: ${stage}`}`;
        }, asking.signal);
        this.sweeps.set(preset.name, sweep);
      } catch (error) {
        if (asking.signal.aborted) return;
        this.serverBox.checked = false;
        this.serverNote.textContent = error instanceof Error ? error.message : String(error);
        return;
      }
    }
    const sweep = this.sweeps.get(preset.name);
    this.serverNote.textContent = this.serverBox.checked && sweep ? sweep.machine.renderer : "";
    this.render();
  }
}

interface Details {
  root: HTMLDetailsElement;
  count: HTMLElement;
  body: HTMLElement;
}

function details(title: string): Details {
  const count = element("span", { class: "fine" });
  const body = element("div", {});
  return { root: element("details", { class: "notes" }, element("summary", {}, element("span", {}, title), count), body), count, body };
}

function table(heads: readonly string[], rows: readonly HTMLTableRowElement[]): HTMLTableElement {
  const head = element("thead", {}, element("tr", {}, ...heads.map((name) => element("th", { scope: "col" }, name))));
  return element("table", {}, head, element("tbody", {}, ...rows));
}

const contentsOf = new WeakMap<HTMLElement, string>();

/** Puts new contents in place of the old, unless they say the same: the keyboard's place in them is kept. */
function replace(parent: HTMLElement, contents: readonly HTMLElement[]): void {
  const text = contents.map(({ outerHTML }) => outerHTML).join("");
  if (contentsOf.get(parent) === text) return;
  const at = [...parent.querySelectorAll("button")].findIndex((button) => button === document.activeElement);
  contentsOf.set(parent, text);
  parent.replaceChildren(...contents);
  if (at >= 0) parent.querySelectorAll("button")[at]?.focus();
}

function cost({ point, rounds, errors }: Measured) {
  return { id: point.id, time: median(rounds), error: errors.rmse };
}

function mark(measured: Measured): Mark {
  const { point, rounds } = measured;
  return { ...cost(measured), label: point.label, tier: point.tier !== null, low: quantile(rounds, 0.25), high: quantile(rounds, 0.75) };
}

function signed(value: number): string {
  if (Math.abs(value) < 5e-4) return "0";
  return `${value < 0 ? "−" : "+"}${short(Math.abs(value))}`;
}

function truthWords({ progress, eta_s: left }: Running): string {
  const share = progress === undefined || progress === 0 ? "" : ` ${Math.round(100 * progress)} %`;
  return `Computing the float64 truth…${share}${typeof left === "number" ? `, ${Math.ceil(left)} s left` : ""}`;
}

function summary({ result, subject, stopped, seconds }: Known): string {
  const count = result.measured.length;
  if (stopped === null) return `${count} qualities in ${Math.round(seconds)} s`;
  return `${stopped} ${count} of ${subject.points.length} qualities measured`;
}

function fineprint({ result, subject }: Known, renderer: string): string {
  const { timed } = result.sizes;
  const { info } = subject;
  const clock = result.byGpu ? "by the GPU’s own clock" : "by the wall clock until a pixel came back";
  return (
    `${renderer}. Times: medians of ${result.rounds} rounds drawn in turn at ${timed[0]} × ${timed[1]}, ${clock}. ` +
    `Errors: linear light clipped at white, ${info.width} × ${info.height} at ${info.time} s, against ${info.samples} samples a pixel in float64.`
  );
}

