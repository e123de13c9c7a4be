/** The user's selection, with change events. Time and camera change every frame and are kept elsewhere. */
import type { Selection } from "./selection";

type SelectionListener = (now: Selection, before: Selection, gesture?: string) => void;

export class Store {
  private readonly listeners = new Set<SelectionListener>();

  constructor(private selection: Selection) {}

  get now(): Selection {
    return this.selection;
  }

  /** `gesture`: names the pointer gesture that makes the change; all its changes are one step of undo. */
  set(change: Partial<Selection>, gesture?: string): void {
    const before = this.selection;
    this.selection = { ...before, ...change };
    for (const listener of this.listeners) listener(this.selection, before, gesture);
  }

  onChange(listener: SelectionListener): void {
    this.listeners.add(listener);
  }
}
