/** Which effects the picture runs, which it leaves out, and why: the plan's own words. */
import type { FramePlan } from "../generated/api";
import { labelOf } from "../panel/model";
import { element } from "./dom";

export class Notes {
  readonly root = element("details", { class: "notes" });

  show(plan: FramePlan | null): void {
    const { open } = this.root;
    const effects = plan?.effects ?? [];
    const skipped = plan?.skipped ?? [];
    const entry = (kind: string) => (note: { name: string; why: string }) =>
      element("li", { class: kind }, element("b", {}, labelOf(note.name)), " ", note.why);
    const count = `${effects.length} ${effects.length === 1 ? "effect runs" : "effects run"}${skipped.length ? `, ${skipped.length} skipped` : ""}`;
    this.root.replaceChildren(
      element("summary", {}, count),
      element("ul", {}, ...effects.map(entry("runs")), ...skipped.map(entry("skipped"))),
    );
    this.root.open = open;
  }
}
