/** A hint on how to begin, which goes away by itself or with the visitor's first move. */
import { element } from "./dom";

const DURATION = 30_000;
const FADE = 600;

/** Shows the hint above the bar; `touch`: where fingers are the main pointer. */
export function showHint(container: HTMLElement, touch: boolean): void {
  const text = touch ? "Touch the water · two fingers look around" : "Touch the water · right drag to look around · W A S D to move · / lists all waters · F fills the screen";
  const hint = element("p", { class: "hint pointer-events-none! justify-self-center rounded-sheet bg-panel px-4 py-2 text-center text-note text-soft transition-opacity duration-500 will-change-[opacity] [&.gone]:opacity-0" }, text);
  container.prepend(hint);
  const events = ["pointerdown", "keydown", "wheel"] as const;
  const leave = () => {
    events.forEach((type) => document.removeEventListener(type, leave));
    clearTimeout(timer);
    hint.classList.add("gone");
    setTimeout(() => hint.remove(), FADE);
  };
  const timer = setTimeout(leave, DURATION);
  events.forEach((type) => document.addEventListener(type, leave, { passive: true }));
}
