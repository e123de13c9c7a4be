/** Effects of the plan: active ones, and skipped ones with the plan's reason. */
import type { FramePlan } from "../generated/api";
import { labelOf } from "../panel/model";
import { element } from "./dom";

export class EffectList {
  readonly root = element("details", { class: "disclosure" });

  show(plan: FramePlan | null): void {
    const { open } = this.root;
    const active = plan?.effects ?? [];
    const skipped = plan?.skipped ?? [];
    const entry = (state: string) => (effect: FramePlan["skipped"][number]) =>
      element("li", { class: state }, element("b", {}, labelOf(effect.name)), " ", effect.why, boundText(effect.bound));
    this.root.replaceChildren(
      element("summary", {}, `${active.length} of ${active.length + skipped.length} effects active`),
      element("ul", {}, ...active.map(entry("active")), ...skipped.map(entry("skipped"))),
    );
    this.root.open = open;
  }
}

/** Greatest pixel change that skipping the effect causes. */
function boundText(bound: number | null | undefined): string {
  if (typeof bound !== "number") return "";
  return bound === 0 ? " (no pixel changes)" : ` (pixels change by at most ${Math.ceil(25500 * bound) / 100} of 255)`;
}
