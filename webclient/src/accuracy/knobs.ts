/** What each knob is worth: the error that it removes for the time that it adds, against the quality all are held against. */
import { get, type Json } from "../scene/json";
import type { Point } from "./api";
import { compare, type Cost } from "./compare";

export interface Timed extends Cost {
  point: Point;
  rounds: readonly number[];
}

/** Less error than this, levels, is none. */
export const NOTHING = 0.01;

export interface Worth {
  owner: string;
  title: string;
  cause: string;
  /** The cheaper value and the dearer one; where time does not tell, the worse and the better. */
  from: string;
  to: string;
  /** The point that is not the common one. */
  id: string;
  added: number;
  measurable: boolean;
  removed: number;
  /** Levels a ms; null where no time that can be measured is added. */
  perMs: number | null;
}

/** Sorted by worth: what removes error for no time first, what adds time and error last. */
export function worths(standard: Timed, points: readonly Timed[]): Worth[] {
  const found = points.flatMap((changed): Worth[] => {
    const { knob } = changed.point;
    if (knob === null || changed.rounds.length === 0) return [];
    const onward = compare(standard.rounds, changed.rounds, 0, 0);
    // From the cheaper to the dearer; where time does not tell, from the worse to the better.
    const forward = onward.measurable ? onward.added >= 0 : changed.error <= standard.error;
    const [first, second] = forward ? [standard, changed] : [changed, standard];
    const { added, measurable } = compare(first.rounds, second.rounds, 0, 0);
    const removed = first.error - second.error;
    const value = (timed: Timed) => shown(timed === standard ? get(standard.point.quality, knob.pointer) : knob.value);
    const perMs = measurable && added > 0 ? removed / added : null;
    const { owner, title, cause } = knob;
    return [{ owner, title, cause, from: value(first), to: value(second), id: changed.id, added, measurable, removed, perMs }];
  });
  // Where time cannot be told apart, a step is as good as its error alone says.
  const rank = ({ perMs, removed }: Worth) => perMs ?? (removed < NOTHING ? 0 : Infinity);
  return found.sort((a, b) => {
    const [x, y] = [rank(a), rank(b)];
    return x === y ? b.removed - a.removed : y - x;
  });
}

function shown(value: Json | undefined): string {
  return typeof value === "string" ? value : JSON.stringify(value ?? null);
}

