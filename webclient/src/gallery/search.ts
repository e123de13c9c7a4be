/** Presets: found by words, their addresses `water/NAME` below the page's root, and where the keyboard goes next in a list of them. */
import type { PresetSummary } from "../api";

const FOLDER = "water/";
const PATH = /\/water\/([\w-]+)$/;

/** Address of a preset. The server gives it title, description and picture. */
export const waterUrl = (name: string) => new URL(FOLDER + encodeURIComponent(name), document.baseURI).href;

/** The preset that a path names, or null. */
export const presetOfPath = (pathname: string) => PATH.exec(pathname)?.[1] ?? null;

/** Whether a click on a link is for the browser, such as for a new tab; otherwise its default is prevented. */
export function followsLink(event: MouseEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return true;
  event.preventDefault();
  return false;
}

/** Presets that contain every word of the query in title, summary, group, name or effects, in the order of the list. */
export function matching(presets: readonly PresetSummary[], query: string): PresetSummary[] {
  const words = plain(query).split(/\s+/).filter(Boolean);
  return presets.filter(({ name, group, title, summary, effects }) => {
    const text = plain([name, group, title, summary, ...effects].join(" ").replaceAll("_", " "));
    return words.every((word) => text.includes(word));
  });
}

/** Consecutive presets of one group. */
export function grouped(presets: readonly PresetSummary[]): { heading: string; presets: PresetSummary[] }[] {
  const groups: ReturnType<typeof grouped> = [];
  for (const preset of presets) {
    const last = groups.at(-1);
    if (last?.heading === preset.group) last.presets.push(preset);
    else groups.push({ heading: preset.group, presets: [preset] });
  }
  return groups;
}

const STEPS: Readonly<Record<string, number>> = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1, Home: -Infinity, End: Infinity };

/** Index that a key goes to in a list, or null if the key does not move; `from` is -1 before the list. */
export function indexAfter(key: string, from: number, count: number): number | null {
  const step = STEPS[key];
  return step === undefined || count === 0 ? null : Math.min(count - 1, Math.max(0, from + step));
}

/** Lower case without accents. */
const plain = (text: string) => text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();
