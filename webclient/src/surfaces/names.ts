/** Names of the surfaces, as links have them. */

export type SurfaceName = "take" | "plan";

export function surfaceName(text: string | undefined): SurfaceName | null {
  return text === "take" || text === "plan" ? text : null;
}
