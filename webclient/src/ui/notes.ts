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
    const entry = (kind: string) => (note: FramePlan["skipped"][number]) =>
      element("li", { class: kind }, element("b", {}, labelOf(note.name)), " ", note.why, most(note.bound));
    const count = `${effects.length} of ${effects.length + skipped.length} effects run`;
    this.root.replaceChildren(
      element("summary", {}, count),
      element("ul", {}, ...effects.map(entry("runs")), ...skipped.map(entry("skipped"))),
    );
    this.root.open = open;
  }
}

/** How much of a skipped effect could be seen at the most. */
function most(bound: number | null | undefined): string {
  if (typeof bound !== "number") return "";
  return bound === 0 ? " (changes nothing)" : ` (changes a pixel by at most ${Math.ceil(25500 * bound) / 100} of 255)`;
}
