/** Makes elements. */

type Attributes = Record<string, string | number | boolean | null>;

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === null) continue;
    made.setAttribute(name, value === true ? "" : String(value));
  }
  made.append(...children);
  return made;
}

/** The page's own elements; the page is broken where one is missing. */
export function byId(id: string): HTMLElement {
  const found = document.getElementById(id);
  if (found === null) throw new Error(`the page has no #${id}`);
  return found;
}

/** A drop-down list; `current` is chosen, and offered even where it is not among the options. */
export function fillSelect(select: HTMLSelectElement, options: readonly { name: string; title: string }[], current: string): void {
  const all = options.some(({ name }) => name === current) ? options : [{ name: current, title: current }, ...options];
  const text = JSON.stringify(all);
  if (select.dataset["options"] !== text) {
    select.dataset["options"] = text;
    select.replaceChildren(...all.map(({ name, title }) => element("option", { value: name }, title)));
  }
  select.value = current;
}
