/** Benefit of each quality setting: the error it removes for the time it adds, relative to the standard quality. */
import { get } from "../../scene/json";
import { valueText } from "../format";
import type { Measured } from "./measured";
import { compare } from "./statistics";

/** Less error than this counts as none, levels. */
export const NEGLIGIBLE = 0.01;

export interface Benefit {
  owner: string;
  title: string;
  cause: string;
  /** From the cheaper value to the dearer; without a measurable time difference, from the worse to the better. */
  from: string;
  to: string;
  /** Id of the point that is not the standard. */
  id: string;
  /** ms */
  added: number;
  measurable: boolean;
  /** Levels. */
  removed: number;
  /** Levels per ms; null if no measurable time is added. */
  perMs: number | null;
}

/** Sorted by benefit: error removed at no cost first. */
export function benefits(standard: Measured, points: readonly Measured[]): Benefit[] {
  const list = points.flatMap((changed): Benefit[] => {
    const { parameter } = changed.point;
    if (parameter === null || changed.rounds.length === 0) return [];
    const comparison = compare(standard.rounds, changed.rounds, 0, 0);
    const ascending = comparison.measurable ? comparison.added >= 0 : changed.error <= standard.error;
    const [first, second] = ascending ? [standard, changed] : [changed, standard];
    const { added, measurable } = compare(first.rounds, second.rounds, 0, 0);
    const removed = first.error - second.error;
    const value = (timed: Measured) => valueText(timed === standard ? (get(standard.point.quality, parameter.pointer) ?? null) : parameter.value);
    const perMs = measurable && added > 0 ? removed / added : null;
    const { owner, title, cause } = parameter;
    return [{ owner, title, cause, from: value(first), to: value(second), id: changed.id, added, measurable, removed, perMs }];
  });
  const rank = ({ perMs, removed }: Benefit) => perMs ?? (removed < NEGLIGIBLE ? 0 : Infinity);
  return list.sort((a, b) => {
    const [rankA, rankB] = [rank(a), rank(b)];
    return rankA === rankB ? b.removed - a.removed : rankB - rankA;
  });
}
