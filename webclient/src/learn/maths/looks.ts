/** Foam amounts of a saturation f, a threshold m and the foam texture t (docs/formulae.md, section 5). */

export const LOOKS = ["textured", "halftone", "fading", "halftone_textured", "listing", "filtered"] as const;
export type Look = (typeof LOOKS)[number];

export const LOOK_TITLES: Record<Look, string> = {
  textured: "Faded texture",
  halftone: "Equation 1",
  fading: "Equation 2",
  halftone_textured: "Equation 3",
  listing: "Listing",
  filtered: "Filtered",
};

/** Smallest amount that a screen of 8 bits shows. */
export const VISIBLE = 0.5 / 255;

function clamp(x: number, low: number, high: number): number {
  return Math.min(Math.max(x, low), high);
}

/** Amount of a look that compares with single texels, in [0, 1]; `listing` in [0, 3], as it is added to the water. */
export function amount(look: Exclude<Look, "filtered">, f: number, m: number, t: number): number {
  if (look === "textured") return clamp(f, 0, 1) * t;
  if (f <= m) return 0;
  switch (look) {
    case "halftone":
      return 1;
    case "fading":
      return clamp(f / 2 - m, 0, 1);
    case "halftone_textured":
      return clamp(f / 2 - m, 0, 1) * t;
    case "listing":
      return clamp(f - m, 0.15, 3) * t;
  }
}
