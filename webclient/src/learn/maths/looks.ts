/** Foam amounts of a saturation f, a threshold m and the foam texture t (docs/formulae.md, section 5), and the bubbles that pop by them. */

export const LOOKS = {
  textured: { title: "Faded texture", formula: "a = f · t" },
  halftone: { title: "Equation 1", formula: "a = 1 where f > m" },
  fading: { title: "Equation 2", formula: "a = f/2 − m where f > m" },
  halftone_textured: { title: "Equation 3", formula: "a = (f/2 − m) · t where f > m" },
  listing: { title: "Listing", formula: "a = max(f − m, 0.15) · t where f > m" },
  filtered: { title: "Filtered", formula: "a = the share of the pixel where f > m" },
} as const;
export type Look = keyof typeof LOOKS;

/** Smallest amount that a screen of 8 bits shows. */
export const VISIBLE = 0.5 / 255;

const clamp = (x: number, low: number, high: number) => Math.min(Math.max(x, low), high);

/** Amount of a look that compares with single texels, in [0, 1]; `listing` in [0, 3], as it is added to the water. */
export function amount(look: Exclude<Look, "filtered">, f: number, m: number, t: number): number {
  if (look === "textured") return clamp(f, 0, 1) * t;
  if (f <= m) return 0;
  switch (look) {
    case "halftone": return 1;
    case "fading": return clamp(f / 2 - m, 0, 1);
    case "halftone_textured": return clamp(f / 2 - m, 0, 1) * t;
    case "listing": return clamp(f - m, 0.15, 3) * t;
  }
}

/** Counts bubbles that pop: whose amount falls from visible to none. */
export class PopCounter {
  /** Since the last call of `advance`. */
  pops = 0;
  private perSecond = 0;
  private readonly visible: Uint8Array;

  constructor(bubbles: number) {
    this.visible = new Uint8Array(bubbles);
  }

  /** The amount of one bubble in the present frame. */
  see(bubble: number, amount: number): void {
    const now = amount > VISIBLE ? 1 : 0;
    if (now === 0 && this.visible[bubble] === 1) this.pops++;
    this.visible[bubble] = now;
  }

  /** After a frame that moved time by `seconds`; returns the rate over about the last second of motion, in words. */
  advance(seconds: number): string {
    // A jump in time pops bubbles that no clock saw.
    if (seconds > 0 && seconds <= 0.25) this.perSecond += (1 - Math.exp(-seconds)) * (this.pops / seconds - this.perSecond);
    this.pops = 0;
    return `${Math.round(this.perSecond).toLocaleString("en")} pops/s`;
  }
}
