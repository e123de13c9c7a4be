/** Masks to choose from. */
import { effect, type Signal } from "@preact/signals";
import type { Api } from "../../api";
import { loadMask, type Mask, WHITE } from "../maths/mask";

/** Names and titles of the shipped masks, and of white noise. */
export async function maskOptions(api: Api): Promise<readonly (readonly [string, string])[]> {
  const masks = await api.choices("api/masks");
  return [[WHITE, "white noise"] as const, ...masks.map(({ name, title }) => [name, title] as const)];
}

/** The mask that a control names; the last one while it loads, or if it cannot be loaded. */
export function followMask(api: Api, name: Signal<string>, mask: Signal<Mask>): void {
  effect(() => {
    const asked = name.value;
    loadMask(api, asked).then(
      (loaded) => {
        if (name.peek() === asked) mask.value = loaded;
      },
      () => (name.value = mask.peek().name),
    );
  });
}
