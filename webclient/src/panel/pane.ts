/** Draws a panel model with Tweakpane. */
import type { BindingApi, FolderApi } from "@tweakpane/core";
import { Pane } from "tweakpane";
import type { Choice } from "../api";
import { child, get, type Json, steps } from "../scene/json";
import { element } from "../ui/dom";
import { type Control, type GroupControl, labelOf, type ListControl, type NumberControl, type OptionalControl, sameControls, switchedOn } from "./model";

interface PaneEvents {
  change(pointer: string, value: Json): void;
  optionsFrom(url: string): readonly Choice[]; // Options listed by the server at a URL; empty until loaded
}

const DEGREE = "°";
const DEGREES = 180 / Math.PI;

export class ScenePane {
  private pane: Pane | null = null;
  private model: GroupControl | null = null;
  /** Copy the scene's values into the widgets. */
  private refreshers: (() => void)[] = [];
  /** State of folders that the user opened or closed, by pointer; kept across rebuilds. */
  private readonly expanded = new Map<string, boolean>();
  private updating = false;
  private scene: Json = null;

  constructor(private readonly container: HTMLElement, private readonly events: PaneEvents) {}

  /** Shows a scene; widgets are rebuilt only if the controls differ. */
  show(model: GroupControl, scene: Json, rebuild = false): void {
    this.scene = scene;
    if (rebuild || this.pane === null || !sameControls(this.model, model)) this.build(model);
    this.updating = true;
    for (const refresh of this.refreshers) refresh();
    this.pane?.refresh();
    this.updating = false;
  }

  private build(model: GroupControl): void {
    const scroll = this.container.parentElement?.scrollTop ?? 0;
    this.pane?.dispose();
    this.model = model;
    this.refreshers = [];
    this.pane = new Pane({ container: this.container });
    for (const control of model.children) this.add(this.pane, control);
    if (this.container.parentElement) this.container.parentElement.scrollTop = scroll;
  }

  private add(parent: FolderApi, control: Control): void {
    switch (control.kind) {
      case "group": {
        const folder = this.folder(parent, control, control.label);
        for (const inner of control.children) this.add(folder, inner);
        return;
      }
      case "optional": return this.addOptional(parent, control);
      case "list": return this.addList(parent, control);
      case "number": return this.addNumber(parent, control);
      case "toggle": return this.addPlain(parent, control, {}, false);
      case "text": return this.addPlain(parent, control, {}, "");
      case "choice":
        return this.addPlain(parent, control, { options: control.options.map((value) => ({ text: labelOf(value), value })) }, "");
      case "name": {
        const current = get(this.scene, control.pointer);
        const options = [...this.events.optionsFrom(control.url)];
        // A name that is not listed, as of a generated mask, stays selectable.
        if (typeof current === "string" && !options.some(({ name }) => name === current)) options.unshift({ name: current, title: current });
        return this.addPlain(parent, control, { options: options.map(({ name, title }) => ({ text: title, value: name })) }, "");
      }
      case "colour": return this.addColour(parent, control);
    }
  }

  private folder(parent: FolderApi, { pointer, hint, kind }: Control, title: string): FolderApi {
    // Open at first: the wind and the first group after it that is not a list, and groups at the second level.
    const groups = this.model?.children.filter((child) => child.kind !== "list" && get(this.scene, child.pointer) !== null) ?? [];
    const first = groups.slice(0, groups[0]?.pointer === "/wind" ? 2 : 1).some((child) => child.pointer === pointer);
    const path = steps(pointer);
    const part = kind !== "list" && path.length === 2 && !/^\d+$/.test(path[1] ?? "");
    const open = first || part;
    const folder = parent.addFolder({ title, expanded: this.expanded.get(pointer) ?? open });
    folder.on("fold", ({ expanded, target }) => {
      if (target === folder) this.expanded.set(pointer, expanded);
    });
    const button = folder.element.querySelector("button");
    if (button) button.title = hint;
    return folder;
  }

  /** A widget that edits what `read` makes of the scene's value, where that gives anything; `write` turns it back. */
  private bind<T>(parent: FolderApi, control: Control, options: object, initial: T, read: (value: Json | undefined) => T | null, write: (value: T) => Json) {
    const bound = { value: initial };
    const refresh = () => (bound.value = read(get(this.scene, control.pointer)) ?? bound.value);
    refresh();
    this.refreshers.push(refresh);
    const binding = parent.addBinding(bound, "value", { label: control.label, ...options });
    describe(binding, control.label, control.hint);
    binding.on("change", ({ value }) => this.changed(control.pointer, write(value)));
    return { binding, bound };
  }

  private addPlain(parent: FolderApi, control: Control, options: object, fallback: string | boolean): void {
    this.bind(parent, control, options, fallback, (value) => (typeof value === "string" || typeof value === "boolean" ? value : null), (value) => value);
  }

  private addNumber(parent: FolderApi, control: NumberControl): void {
    const { min, max, logarithmic } = control;
    const bounded = min !== null && max !== null;
    const span = bounded ? toDisplayed(control, max - min) : 100;
    const options = {
      // With bounds Tweakpane adds a linear slider; a logarithmic range has its own slider.
      ...(bounded && !logarithmic ? { min: toDisplayed(control, min), max: toDisplayed(control, max) } : {}),
      ...(control.step === 1 ? { step: 1 } : { keyScale: span / 200, pointerScale: span / 1000 }),
      // At most four significant digits.
      format: (value: number) => `${Number(value.toPrecision(4))}${control.angle ? DEGREE : ""}`,
    };
    const read = (value: Json | undefined) => (typeof value === "number" ? toDisplayed(control, value) : null);
    const { binding, bound } = this.bind(parent, control, options, 0, read, (value) => fromDisplayed(control, value));
    if (!logarithmic || !bounded) return;
    this.refreshers.push(addLogSlider(binding, bound, min, max));
    describe(binding, control.label, control.hint);
  }

  private addColour(parent: FolderApi, control: Control): void {
    const read = (value: Json | undefined) => {
      if (!Array.isArray(value)) return null;
      const [r = 0, g = 0, b = 0] = value.map(Number);
      return { r, g, b };
    };
    this.bind(parent, control, { color: { type: "float" } }, { r: 0, g: 0, b: 0 }, read, ({ r, g, b }) => [r, g, b].map((c) => Number(c.toFixed(4))));
  }

  private addOptional(parent: FolderApi, control: OptionalControl): void {
    const { inner } = control;
    const target = inner?.kind === "group" ? this.folder(parent, control, control.label) : parent;
    const label = inner?.kind === "group" ? "on" : control.label;
    this.bind(target, control, { label }, inner !== null, () => inner !== null, (on) => (on ? switchedOn(control, this.scene) : null));
    if (inner === null) return;
    if (inner.kind === "group") for (const each of inner.children) this.add(target, each);
    else this.add(target, { ...inner, label: "", hint: inner.hint || control.label });
  }

  private addList(parent: FolderApi, control: ListControl): void {
    const folder = this.folder(parent, control, `${control.label} (${control.items.length})`);
    const current = () => {
      const value = get(this.scene, control.pointer);
      return Array.isArray(value) ? value : [];
    };
    control.items.forEach(({ control: item, variant }, i) => {
      const name = variant === null ? item.label : `${i + 1} · ${labelOf(variant)}`;
      const inside = this.folder(folder, item, name);
      if (control.variants.length > 1 && variant !== null) {
        const options = control.variants.map(({ name: value }) => ({ text: labelOf(value), value }));
        const described = { ...item, label: control.discriminator ?? "kind", hint: control.variants.map((v) => `${v.name}: ${v.hint}`).join("\n") };
        this.bind(inside, described, { options }, variant, () => variant, (chosen) => control.variants.find((v) => v.name === chosen)?.initial ?? null);
      }
      if (item.kind === "group") for (const inner of item.children) this.add(inside, inner);
      else this.add(inside, item);
      if (control.items.length > control.minItems) {
        inside.addButton({ title: "Remove" }).on("click", () => this.changed(control.pointer, current().filter((_, k) => k !== i)));
      }
    });
    if (control.items.length >= control.maxItems) return;
    for (const { name, initial, hint } of control.variants) {
      const button = folder.addButton({ title: `Add ${labelOf(name)}` });
      button.element.title = hint;
      button.on("click", () => {
        this.expanded.set(child(control.pointer, current().length), true);
        this.changed(control.pointer, [...current(), initial]);
      });
    }
  }

  private changed(pointer: string, value: Json): void {
    // After Tweakpane has dealt with the event, for which it needs the widgets: a change may build them anew.
    if (!this.updating) queueMicrotask(() => this.events.change(pointer, value));
  }
}

/** Adds a logarithmic slider beside the number; returns its refresh function. */
function addLogSlider(binding: BindingApi, bound: { value: number }, min: number, max: number): () => void {
  const slider = element("input", { type: "range", class: "log", min: Math.log10(min), max: Math.log10(max), step: "any" });
  const refresh = () => {
    const log = Math.log10(Math.max(bound.value, min));
    slider.value = String(log);
    const share = (log - Math.log10(min)) / Math.log10(max / min);
    slider.style.setProperty("--share", `${100 * Math.min(1, share)}%`);
  };
  slider.addEventListener("input", () => {
    // A slider's resolution is about three digits.
    bound.value = Number((10 ** Number(slider.value)).toPrecision(3));
    binding.refresh();
  });
  const place = binding.element.querySelector(".tp-lblv_v");
  place?.classList.add("with-log");
  place?.prepend(slider);
  refresh();
  return refresh;
}

function describe(binding: BindingApi, label: string, hint: string): void {
  binding.element.title = hint;
  for (const input of binding.element.querySelectorAll("input, select")) input.setAttribute("aria-label", label || hint);
}

/** A number of the scene as its control shows it. */
export const toDisplayed = (control: NumberControl, value: number): number => (control.angle ? Number((value * DEGREES).toFixed(3)) : value);

/** Of the scene: rounded to the control's step and clamped to the schema's range. */
export function fromDisplayed(control: NumberControl, value: number): number {
  const rounded = control.angle ? Number((value / DEGREES).toFixed(5)) : snap(value, control.step);
  return Math.min(control.max ?? Infinity, Math.max(control.min ?? -Infinity, rounded));
}

function snap(value: number, step: number | null): number {
  if (step === null) return value;
  const digits = Math.max(0, Math.ceil(-Math.log10(step)));
  return Number((Math.round(value / step) * step).toFixed(digits));
}
