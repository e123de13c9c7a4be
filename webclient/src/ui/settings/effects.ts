/** Effects of the plan: active ones, and skipped ones with the plan's reason. */
import type { FramePlan } from "../../generated/api";
import { labelOf } from "../../panel/model";
import { element } from "../dom";

const ENTRY = "relative py-1 pl-5 before:absolute before:top-[11px] before:left-0.5 before:size-1.5 before:rounded-full";
const ACTIVE = `active ${ENTRY} before:bg-teal`;
const SKIPPED = `skipped ${ENTRY} before:border before:border-faint`;

export class EffectList {
  readonly root = element("details", { class: "disclosure px-1.5" });

  show(plan: FramePlan | null): void {
    const { open } = this.root;
    const active = plan?.effects ?? [];
    const skipped = plan?.skipped ?? [];
    const entry = (state: string) => (effect: FramePlan["skipped"][number]) =>
      element("li", { class: state }, element("b", { class: "inline-block font-semibold text-ink first-letter:uppercase" }, labelOf(effect.name)), " ", effect.why, boundText(effect.bound));
    this.root.replaceChildren(
      element("summary", {}, `${active.length} of ${active.length + skipped.length} effects active`),
      element("ul", { class: "mb-3 text-fine text-soft" }, ...active.map(entry(ACTIVE)), ...skipped.map(entry(SKIPPED))),
    );
    this.root.open = open;
  }
}

/** Greatest pixel change that skipping the effect causes. */
function boundText(bound: number | null | undefined): string {
  if (typeof bound !== "number") return "";
  return bound === 0 ? " (no pixel changes)" : ` (pixels change by at most ${Math.ceil(25500 * bound) / 100} of 255)`;
}
