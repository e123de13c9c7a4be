/** Result sections of the benchmark: the selected quality, pass times, benefit of each setting, table of all qualities. */
import { labelOf } from "../panel/model";
import { element } from "../ui/dom";
import { type Benefit, benefits, NEGLIGIBLE } from "./benefit";
import type { BenchmarkResult, QualityResult } from "./benchmark";
import { formatNumber, formatSigned } from "./format";
import { compare, median, paretoFront, quantile } from "./statistics";

/** Id, median time and error of a result. */
export function costOf({ point, rounds, errors }: QualityResult) {
  return { id: point.id, time: median(rounds), error: errors.rmse };
}

export class ResultSections {
  readonly selected = element("section", { class: "selected", "aria-live": "polite" });
  private readonly passes = disclosure("Time by pass");
  private readonly benefits = disclosure("Benefit of each setting");
  private readonly table = disclosure("All qualities");
  readonly details = [this.passes.root, this.benefits.root, this.table.root];
  private highlighted: string | null = null;

  constructor(private readonly select: (id: string) => void) {
    this.benefits.root.open = true;
  }

  /** `current`: what the page runs, if it was measured. */
  show(result: BenchmarkResult, standard: QualityResult, current: QualityResult | null): void {
    this.showSelected(current ?? standard, standard, current === null);
    this.showPasses(current ?? standard);
    this.showBenefits(standard, result.measured);
    this.showTable(result, current);
  }

  /** Highlights the table row of a quality. */
  highlight(id: string | null): void {
    this.highlighted = id;
    for (const row of this.table.body.querySelectorAll("tr")) row.classList.toggle("highlighted", id !== null && row.dataset["id"] === id);
  }

  private showSelected({ point, errors, rounds }: QualityResult, standard: QualityResult, currentUnmeasured: boolean): void {
    const { summary } = compare(standard.rounds, rounds, standard.errors.rmse, errors.rmse);
    const sentence = point === standard.point ? "Other qualities are compared with this one." : `Compared with ${standard.point.label}: ${summary}.`;
    const figure = (name: string, value: string, unit: string) =>
      element("div", {}, element("dt", {}, name), element("dd", {}, element("b", {}, value), " ", unit));
    replaceContents(this.selected, [
      element("h3", {}, point.label),
      element("p", { class: "sentence" }, sentence),
      element(
        "dl",
        {},
        figure("frame time", formatNumber(median(rounds)), "ms"),
        figure("RMSE", formatNumber(errors.rmse), "levels"),
        figure("maximum", formatNumber(errors.max), "levels"),
        figure("foam coverage", (100 * errors.coverage).toFixed(1), "%"),
      ),
      ...(currentUnmeasured ? [element("p", { class: "fine" }, "The current quality was not measured.")] : []),
    ]);
  }

  private showPasses({ passes }: QualityResult): void {
    const total = passes.reduce((sum, { time }) => sum + time, 0);
    this.passes.note.textContent = `${passes.length} ${passes.length === 1 ? "pass" : "passes"}`;
    const items = [...passes]
      .sort((a, b) => b.time - a.time)
      .map(({ name, time }) => {
        const item = element("li", {}, element("span", {}, name), element("span", { class: "number" }, `${formatNumber(time)} ms`));
        item.style.setProperty("--share", `${(100 * time) / total}%`);
        return item;
      });
    replaceContents(this.passes.body, [element("ol", { class: "passes" }, ...items)]);
  }

  private showBenefits(standard: QualityResult, measured: readonly QualityResult[]): void {
    const timed = (result: QualityResult) => ({ ...costOf(result), point: result.point, rounds: result.rounds });
    this.benefits.note.textContent = "error removed per added ms";
    const rows = benefits(timed(standard), measured.map(timed)).map((benefit) => this.benefitRow(benefit));
    replaceContents(this.benefits.body, [table(["setting", "ms added", "error removed", "per ms"], rows)]);
  }

  private benefitRow({ id, title, owner, cause, from, to, added, measurable, removed, perMs }: Benefit): HTMLTableRowElement {
    const useless = removed < NEGLIGIBLE;
    return element(
      "tr",
      { "data-id": id, class: useless ? "muted" : null },
      element(
        "th",
        { scope: "row", title: `${labelOf(owner)}, affects ${cause}` },
        this.selectButton(id, title),
        element("span", { class: "values" }, `${from} → ${to}`),
      ),
      element("td", {}, measurable ? formatSigned(added) : "≈ 0"),
      element("td", {}, formatSigned(removed)),
      element("td", { class: "per-ms" }, perMs === null ? (useless ? "–" : "free") : formatSigned(perMs)),
    );
  }

  private showTable({ measured, unsupported }: BenchmarkResult, current: QualityResult | null): void {
    const onFront = new Set(paretoFront(measured.map(costOf)).map(({ id }) => id));
    this.table.note.textContent = `${measured.length + unsupported.length}`;
    const rows = [...measured]
      .sort((a, b) => median(a.rounds) - median(b.rounds))
      .map(({ point, rounds, errors }) =>
        element(
          "tr",
          { "data-id": point.id, "aria-current": point === current?.point ? "true" : null },
          element(
            "th",
            { scope: "row" },
            this.selectButton(point.id, point.label),
            ...(onFront.has(point.id) ? [element("span", { class: "values" }, "on the Pareto front")] : []),
          ),
          element("td", { title: `quartiles ${formatNumber(quantile(rounds, 0.25))} to ${formatNumber(quantile(rounds, 0.75))} ms` }, formatNumber(median(rounds))),
          element("td", {}, formatNumber(errors.rmse)),
          element("td", {}, formatNumber(errors.max)),
          element("td", {}, (100 * errors.coverage).toFixed(1)),
        ),
      );
    rows.push(
      ...unsupported.map(({ point, reason }) =>
        element("tr", { class: "muted" }, element("th", { scope: "row" }, point.label), element("td", { colspan: 4 }, reason)),
      ),
    );
    replaceContents(this.table.body, [table(["quality", "ms", "RMSE", "max", "foam %"], rows)]);
    this.highlight(this.highlighted);
  }

  private selectButton(id: string, label: string): HTMLButtonElement {
    const button = element("button", { type: "button", class: "select", title: `Select ${label}` }, label);
    button.addEventListener("click", () => this.select(id));
    return button;
  }
}

function disclosure(title: string): { root: HTMLDetailsElement; note: HTMLElement; body: HTMLElement } {
  const note = element("span", { class: "fine" });
  const body = element("div");
  const root = element("details", { class: "disclosure" }, element("summary", {}, element("span", {}, title), note), body);
  return { root, note, body };
}

function table(heads: readonly string[], rows: readonly HTMLTableRowElement[]): HTMLTableElement {
  const head = element("thead", {}, element("tr", {}, ...heads.map((name) => element("th", { scope: "col" }, name))));
  return element("table", {}, head, element("tbody", {}, ...rows));
}

const currentContents = new WeakMap<HTMLElement, string>();

/** Replaces an element's contents if they differ; keeps the keyboard focus on the button at the same index. */
function replaceContents(parent: HTMLElement, contents: readonly HTMLElement[]): void {
  const html = contents.map(({ outerHTML }) => outerHTML).join("");
  if (currentContents.get(parent) === html) return;
  const focused = [...parent.querySelectorAll("button")].findIndex((button) => button === document.activeElement);
  currentContents.set(parent, html);
  parent.replaceChildren(...contents);
  if (focused >= 0) parent.querySelectorAll("button")[focused]?.focus();
}
