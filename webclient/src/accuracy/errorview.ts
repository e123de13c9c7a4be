/** A quality's picture beside its error map or the reference, with a movable split. */
import { element } from "../ui/dom";
import type { QualityResult } from "./benchmark";
import { drawErrors, drawPicture, HEAT_GRADIENT } from "./colormap";
import { errorMap, percentile } from "./errors";
import type { Picture } from "./npy";

/** The colour scale ends at this percentile of the standard quality's errors. */
const LEGEND_PERCENTILE = 0.97;

const SIDES = ["error", "reference"] as const;

export class ErrorView {
  readonly root = element("figure");
  private readonly left = element("canvas", { role: "img" });
  private readonly right = element("canvas", { role: "img", class: "right" });
  private readonly frame = element("div", { class: "frame" }, this.left, this.right, element("div", { class: "line" }));
  private readonly slider = element("input", { type: "range", min: 0, max: 100, step: 1, value: 50, "aria-label": "Split position" });
  private readonly caption = element("span");
  private readonly legendMax = element("span");
  private readonly legend = element("div", { class: "legend" }, element("span", {}, "0"), element("i"), this.legendMax);
  private side: (typeof SIDES)[number] = "error";
  private shown: { result: QualityResult; standard: QualityResult; truth: Picture } | null = null;

  constructor() {
    const buttons = SIDES.map((side) => {
      const button = element("button", { type: "button", "aria-pressed": String(side === this.side) }, side);
      button.addEventListener("click", () => {
        this.side = side;
        for (const other of buttons) other.setAttribute("aria-pressed", String(other === button));
        this.draw();
      });
      return button;
    });
    this.slider.addEventListener("input", () => this.frame.style.setProperty("--at", `${this.slider.value}%`));
    this.frame.append(this.slider);
    this.legend.style.setProperty("--ramp", HEAT_GRADIENT);
    const toggle = element("div", { class: "toggle", role: "group", "aria-label": "Compare with" }, ...buttons);
    this.root.append(element("figcaption", {}, this.caption, toggle), this.frame, this.legend);
  }

  show(result: QualityResult, standard: QualityResult, truth: Picture): void {
    const { shown } = this;
    if (shown?.result === result && shown.standard === standard && shown.truth === truth) return;
    this.shown = { result, standard, truth };
    this.draw();
  }

  private draw(): void {
    if (this.shown === null) return;
    const { result, standard, truth } = this.shown;
    const { width, height } = truth;
    const { label } = result.point;
    this.frame.style.aspectRatio = `${width} / ${height}`;
    this.caption.textContent = label;
    drawPicture(this.left, result.picture);
    this.left.setAttribute("aria-label", `Picture at quality ${label}`);
    // The same scale for all qualities, so that they can be compared.
    const max = roundUp(percentile(errorMap(standard.picture, truth), LEGEND_PERCENTILE));
    if (this.side === "error") drawErrors(this.right, width, height, errorMap(result.picture, truth), max);
    else drawPicture(this.right, truth);
    this.right.setAttribute("aria-label", this.side === "error" ? `Error map, 0 to ${max} levels` : "Float64 reference");
    this.legend.classList.toggle("idle", this.side !== "error");
    this.legendMax.textContent = `≥ ${max} levels of 255`;
  }
}

/** Next number of 1, 2 or 5 times a power of ten. */
function roundUp(value: number): number {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return ([1, 2, 5].find((step) => step * power >= value) ?? 10) * power;
}
