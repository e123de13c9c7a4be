/** Selects the quality with the least error within a frame time budget at the window's size. */
import type { Viewport } from "../app/viewport";
import { element } from "../ui/dom";
import type { BenchmarkResult } from "./benchmark";
import { formatNumber } from "./format";
import { costOf } from "./results";
import { fitModel, median, selectForBudget } from "./statistics";

/** A frame at 60 fps, ms. */
const DEFAULT_BUDGET = 16;

export class BudgetForm {
  private readonly input = element("input", { type: "number", inputmode: "decimal", id: "budget", min: 0.01, step: "any", value: DEFAULT_BUDGET });
  readonly message = element("p", { class: "budget-message", role: "status" });
  readonly root = element(
    "form",
    { class: "budget" },
    element("label", { for: "budget" }, "Frame budget"),
    element("span", { class: "field" }, this.input, element("span", {}, "ms")),
    element("button", { type: "submit", class: "primary" }, "Select quality"),
  );

  constructor(
    private readonly viewport: Viewport,
    private readonly result: () => BenchmarkResult | null,
    private readonly select: (id: string) => void,
  ) {
    this.root.addEventListener("submit", (event) => {
      event.preventDefault();
      this.apply();
    });
  }

  private apply(): void {
    const result = this.result();
    const budget = this.input.valueAsNumber;
    if (!result || !(budget > 0)) return;
    const page = this.viewport.timing();
    const [width, height] = [Math.round(page.width / page.scale), Math.round(page.height / page.scale)];
    const { large, small } = result.sizes;
    const predicted = result.measured.map((measured) => {
      const { fixed, perPixel } = fitModel(median(measured.rounds), large[0] * large[1], median(measured.small), small[0] * small[1]);
      return { ...costOf(measured), time: fixed + perPixel * width * height, label: measured.point.label };
    });
    const selection = selectForBudget(predicted, budget);
    if (selection === null) return;
    const { point, fits, fitting } = selection;
    this.select(point.id);
    const reason = fits
      ? `least error of ${fitting} qualities within the budget (${predicted.length} measured)`
      : `fastest of ${predicted.length} qualities; none is within the budget`;
    this.message.replaceChildren(
      "Selected ",
      element("b", {}, point.label),
      `: ${reason}. Predicted at ${width} × ${height}: ${formatNumber(point.time)} of ${formatNumber(budget)} ms a frame, RMSE ${formatNumber(point.error)} levels.`,
    );
  }
}
