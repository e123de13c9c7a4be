/** The laboratory's controls, and their form in its address. */
import { type Signal, signal } from "@preact/signals";
import { WHITE } from "../maths/mask";
import { CONSTANTS } from "../maths/wave";

/** A number of the address with its range. */
type Range = { min: number; max: number; start: number };

export const RANGES = {
  delta: { min: 0.8, max: 2.2, start: CONSTANTS.text.delta },
  base: { min: 1.2, max: 8, start: CONSTANTS.text.base },
  c: { min: 0.5, max: 30, start: 4 },
  k: { min: 1, max: 8, start: 3 },
  fade: { min: 0, max: 0.6, start: 0.2 },
  speed: { min: 0.05, max: 2, start: 0.5 },
  grey: { min: 0.03, max: 0.9, start: 0.25 },
} as const satisfies Record<string, Range>;

type NumberName = keyof typeof RANGES;
export const NUMBERS = Object.keys(RANGES) as NumberName[];

export const MASKS = { mask: "vac-24", other: WHITE } as const;
const NAME = /^[a-z0-9.-]{1,40}$/;

export interface LabState {
  numbers: Record<NumberName, Signal<number>>;
  mask: Signal<string>;
  other: Signal<string>;
  time: number; // s; where a paused laboratory stands
  paused: boolean;
}

/** The state of an address's fragment; what it does not say, or says out of range, has its starting value. */
export function parseState(fragment: string): LabState {
  const link = new URLSearchParams(fragment.replace(/^#/, ""));
  const numberOf = (name: string, { min, max, start }: Range) => {
    const text = link.get(name);
    const value = Number(text);
    return text !== null && text !== "" && value >= min && value <= max ? value : start;
  };
  const maskOf = (name: keyof typeof MASKS) => {
    const asked = link.get(name);
    return asked !== null && NAME.test(asked) ? asked : MASKS[name];
  };
  const numbers = Object.fromEntries(NUMBERS.map((name) => [name, signal(numberOf(name, RANGES[name]))])) as LabState["numbers"];
  const time = numberOf("time", { min: 0, max: 1e6, start: 0.9 });
  return { numbers, mask: signal(maskOf("mask")), other: signal(maskOf("other")), time, paused: link.get("paused") === "1" };
}

/** The fragment that `parseState` reads; starting values are left out. */
export function formatState({ numbers, mask, other, time, paused }: LabState): string {
  const link = new URLSearchParams();
  for (const name of NUMBERS) if (numbers[name].value !== RANGES[name].start) link.set(name, String(numbers[name].value));
  if (mask.value !== MASKS.mask) link.set("mask", mask.value);
  if (other.value !== MASKS.other) link.set("other", other.value);
  if (paused) {
    link.set("time", time.toFixed(3));
    link.set("paused", "1");
  }
  const text = link.toString();
  return text === "" ? "" : `#${text}`;
}
