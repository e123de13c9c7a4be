/** Split view of two values of one field, with a divider that is dragged or moved by the arrow keys. */
import "./splitview.css";
import type { Split } from "../app/store";
import { labelOf } from "../panel/model";
import { element, fillSelect } from "./dom";

export interface ComparableField {
  field: string;
  title: string;
  options: readonly { name: string; title: string }[];
}

export class SplitView {
  private readonly handle = element("div", {
    class: "handle",
    role: "slider",
    tabindex: 0,
    "aria-label": "Split position",
    "aria-valuemin": 0,
    "aria-valuemax": 100,
  });
  private readonly field = element("select", { "aria-label": "Compared field" });
  private readonly left = element("select", { "aria-label": "Left value" });
  private readonly right = element("select", { "aria-label": "Right value" });
  private split: Split | null = null;

  constructor(
    private readonly container: HTMLElement,
    private readonly change: (split: Split) => void,
    private readonly compareBy: (field: string) => void,
  ) {
    const selects = element("div", { class: "split-controls" }, this.left, this.field, this.right);
    container.append(element("div", { class: "line" }), this.handle, selects);
    this.handle.addEventListener("pointerdown", (event) => this.handle.setPointerCapture(event.pointerId));
    this.handle.addEventListener("pointermove", (event) => {
      if (this.handle.hasPointerCapture(event.pointerId)) this.move(event.clientX / container.clientWidth);
    });
    this.handle.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 }[event.key];
      if (step === undefined || !this.split) return;
      event.preventDefault();
      this.move(this.split.at + step);
    });
    this.field.addEventListener("change", () => this.compareBy(this.field.value));
    const changeValues = () => this.split && this.change({ ...this.split, left: this.left.value, right: this.right.value });
    this.left.addEventListener("change", changeValues);
    this.right.addEventListener("change", changeValues);
  }

  show(split: Split | null, fields: readonly ComparableField[]): void {
    this.split = split;
    this.container.hidden = split === null;
    if (split === null) return;
    const options = fields.find(({ field }) => field === split.field)?.options ?? [];
    fillSelect(this.field, fields.map(({ field: name, title }) => ({ name, title })), split.field);
    fillSelect(this.left, options, split.left);
    fillSelect(this.right, options, split.right);
    this.container.style.setProperty("--at", `${split.at * 100}%`);
    this.handle.setAttribute("aria-valuenow", String(Math.round(split.at * 100)));
  }

  private move(at: number): void {
    if (this.split) this.change({ ...this.split, at: Math.min(0.98, Math.max(0.02, at)) });
  }
}

export function plainOptions(names: readonly string[]): { name: string; title: string }[] {
  return names.map((name) => ({ name, title: labelOf(name) }));
}
