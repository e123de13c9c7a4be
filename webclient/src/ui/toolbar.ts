/** The toolbar: one round button a tool. */
import { element } from "./dom";
import { icon, type IconName } from "./icons";

export interface Tool {
  icon: IconName;
  label: string;
  run: () => void;
}

export function fillToolbar(container: HTMLElement, tools: readonly Tool[]): void {
  for (const { icon: name, label, run } of tools) {
    const button = element("button", { type: "button", class: "round", "data-tool": name, title: label, "aria-label": label }, icon(name));
    button.addEventListener("click", run);
    container.append(button);
  }
}
