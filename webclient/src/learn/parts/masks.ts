/** Masks to choose from. */
import type { Api } from "../../api";
import { WHITE } from "../maths/mask";

/** Names and titles of the shipped masks, and of white noise. */
export async function maskOptions(api: Api): Promise<readonly (readonly [string, string])[]> {
  const masks = await api.choices("api/masks");
  return [[WHITE, "white noise"] as const, ...masks.map(({ name, title }) => [name, title] as const)];
}
