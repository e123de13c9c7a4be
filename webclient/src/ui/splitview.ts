/** Split view of two values of one field, with a divider that is dragged or moved by the arrow keys. */
import type { ComparableField, Split } from "../selection/selection";
import { dropDown, element, fillSelect } from "./dom";

const VALUE = "pick field-sizing-content max-w-60 phone:max-w-none phone:min-w-0 phone:flex-1";
/** A disc with an arrowhead at each side. */
const HANDLE =
  "handle pointer-events-auto absolute top-1/2 left-(--at) -m-5.5 size-11 cursor-ew-resize touch-none rounded-full bg-solid shadow-[inset_0_0_0_1px_rgb(240_248_250/60%),0_4px_18px_rgb(0_0_0/40%)] " +
  "before:absolute before:top-4.5 before:left-3 before:size-[7px] before:rotate-45 before:border-b-[1.5px] before:border-l-[1.5px] before:border-ink " +
  "after:absolute after:top-4.5 after:right-3 after:size-[7px] after:rotate-225 after:border-b-[1.5px] after:border-l-[1.5px] after:border-ink " +
  "forced-colors:border forced-colors:border-[ButtonText]";

export class SplitView {
  private readonly handle = element("div", {
    class: HANDLE,
    role: "slider",
    tabindex: 0,
    "aria-label": "Split position",
    "aria-valuemin": 0,
    "aria-valuemax": 100,
  });
  private readonly field = dropDown({ class: "pick field-sizing-content max-w-60 text-fine text-soft phone:max-w-[92px] phone:flex-none", "aria-label": "Compared field" }, (field) => this.compareBy(field));
  private readonly left = dropDown({ class: VALUE, "aria-label": "Left value" }, (left) => this.update({ left }));
  private readonly right = dropDown({ class: VALUE, "aria-label": "Right value" }, (right) => this.update({ right }));
  private split: Split | null = null;

  constructor(
    private readonly container: HTMLElement,
    private readonly change: (split: Split) => void,
    private readonly compareBy: (field: string) => void,
  ) {
    const selects = element("div", { class: "pointer-events-auto absolute bottom-[calc(176px+env(safe-area-inset-bottom))] left-1/2 flex -translate-x-1/2 items-center rounded-xl border border-line bg-panel px-1 phone:bottom-[calc(184px+env(safe-area-inset-bottom))] phone:w-inner" }, this.left, this.field, this.right);
    container.append(element("div", { class: "absolute inset-y-0 left-(--at) w-px bg-[rgb(240_248_250/75%)] shadow-[0_0_12px_rgb(0_0_0/45%)]" }), this.handle, selects);
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
    this.update({ at: Math.min(0.98, Math.max(0.02, at)) });
  }

  private update(part: Partial<Split>): void {
    if (this.split) this.change({ ...this.split, ...part });
  }
}
