/** Elements and fields of the page, downloads and the clipboard. */

type Attributes = Record<string, string | number | boolean | null>;

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === null) continue;
    node.setAttribute(name, value === true ? "" : String(value));
  }
  node.append(...children);
  return node;
}

/** A button; `press`: what it does. */
export function button(attributes: Attributes, press: () => void, ...children: (Node | string)[]): HTMLButtonElement {
  const node = element("button", { type: "button", ...attributes }, ...children);
  node.addEventListener("click", press);
  return node;
}

/** A drop-down list; `choose`: called with the chosen value. */
export function dropDown(attributes: Attributes, choose: (value: string) => void): HTMLSelectElement {
  const node = element("select", attributes);
  node.addEventListener("change", () => choose(node.value));
  return node;
}

export function byId(id: string): HTMLElement {
  const node = document.getElementById(id);
  if (node === null) throw new Error(`The page has no element #${id}.`);
  return node;
}

/** Fills a drop-down list and selects `current`, which is added if it is not among the options. */
export function fillSelect(select: HTMLSelectElement, options: readonly { name: string; title: string }[], current: string): void {
  const entries = options.some(({ name }) => name === current) ? options : [{ name: current, title: current }, ...options];
  const text = JSON.stringify(entries);
  if (select.dataset["options"] !== text) {
    select.dataset["options"] = text;
    select.replaceChildren(...entries.map(({ name, title }) => element("option", { value: name }, title)));
  }
  select.value = current;
}

/** Whether the visitor wants little motion. */
export const prefersReducedMotion = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

/** Whether a key is pressed with a modifier: the browser's own shortcuts are. */
export const hasModifier = ({ ctrlKey, metaKey, altKey }: KeyboardEvent) => ctrlKey || metaKey || altKey;

/** Whether a key is typed into a field, where it is no shortcut. */
export function isTyping({ target }: KeyboardEvent): boolean {
  return target instanceof HTMLElement && target.matches("input:not([type=range]), select, textarea");
}

/** Saves a file through the browser's download. */
export function download(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  element("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/**
 * Copies text; returns whether it did. A page over plain HTTP, but for localhost, has no `navigator.clipboard`, and an embedded one may
 * not use it: there the browser's older command copies a selection.
 */
export async function copyText(text: string): Promise<boolean> {
  // Absent on such pages, whatever the types say.
  const { clipboard } = navigator as { clipboard?: Clipboard };
  if (await clipboard?.writeText(text).then(() => true, () => false)) return true;
  const focused = document.activeElement;
  const area = document.createElement("textarea");
  area.value = text;
  area.readOnly = true;
  Object.assign(area.style, { position: "fixed", inset: "0 auto auto 0", opacity: "0" });
  // What lies outside of an open dialog cannot be selected.
  (focused?.closest("dialog") ?? document.body).append(area);
  area.select();
  // eslint-disable-next-line @typescript-eslint/no-deprecated -- nothing else copies there
  const copied = document.execCommand("copy");
  area.remove();
  if (focused instanceof HTMLElement) focused.focus();
  return copied;
}
