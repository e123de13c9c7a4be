/** A quality's picture beside its error or the truth: one frame, a line to drag between the two. */
import { element } from "../ui/dom";
import { errorMap, percentile } from "./errors";
import { paintErrors, paintPicture, WARMTH_CSS } from "./heat";
import type { Measured } from "./measure";
import type { Picture } from "./npy";

/** The warmest colour is for what so many pixels of the common quality keep under. */
const SHARE = 0.97;

type Side = "error" | "reference";

export class Compared {
  readonly root = element("figure", { class: "compared" });
  private readonly left = element("canvas", { role: "img" });
  private readonly right = element("canvas", { role: "img", class: "right" });
  private readonly frame = element("div", { class: "frame" }, this.left, this.right, element("div", { class: "line" }));
  private readonly divider = element("input", {
    type: "range",
    min: 0,
    max: 100,
    step: 1,
    value: 50,
    "aria-label": "Divider between the picture and what it is held against",
  });
  private readonly sides = element("div", { class: "choice", role: "group", "aria-label": "Held against" });
  private readonly leftName = element("span", {});
  private readonly most = element("span", {});
  private readonly legend = element("div", { class: "legend" }, element("span", {}, "0"), element("i", {}), this.most);
  private side: Side = "error";
  private shown: { measured: Measured; standard: Measured; truth: Picture } | null = null;

  constructor() {
    const buttons = (["error", "reference"] as const).map((side) => {
      const button = element("button", { type: "button", "aria-pressed": String(side === this.side) }, side);
      button.addEventListener("click", () => {
        this.side = side;
        for (const other of buttons) other.setAttribute("aria-pressed", String(other === button));
        this.paint();
      });
      return button;
    });
    this.sides.append(...buttons);
    this.divider.addEventListener("input", () => this.frame.style.setProperty("--at", `${this.divider.value}%`));
    this.frame.append(this.divider);
    this.legend.style.setProperty("--ramp", WARMTH_CSS);
    this.root.append(
      element("figcaption", {}, this.leftName, this.sides),
      this.frame,
      this.legend,
    );
  }

  show(measured: Measured, standard: Measured, truth: Picture): void {
    const { shown } = this;
    if (shown?.measured === measured && shown.standard === standard && shown.truth === truth) return;
    this.shown = { measured, standard, truth };
    this.paint();
  }

  private paint(): void {
    if (this.shown === null) return;
    const { measured, standard, truth } = this.shown;
    const { width, height } = truth;
    const { label } = measured.point;
    this.frame.style.aspectRatio = `${width} / ${height}`;
    this.leftName.textContent = label;
    paintPicture(this.left, measured.picture);
    this.left.setAttribute("aria-label", `The picture at ${label}`);
    // One scale for all qualities, so that they can be told apart.
    const most = nice(percentile(errorMap(standard.picture, truth), SHARE));
    if (this.side === "error") paintErrors(this.right, width, height, errorMap(measured.picture, truth), most);
    else paintPicture(this.right, truth);
    this.right.setAttribute("aria-label", this.side === "error" ? `Its error, up to ${most} levels and more` : "The float64 reference");
    this.legend.classList.toggle("idle", this.side !== "error");
    this.most.textContent = `≥ ${most} levels of 255`;
  }
}

/** The next round number. */
function nice(value: number): number {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return ([1, 2, 5].find((step) => step * power >= value) ?? 10) * power;
}
