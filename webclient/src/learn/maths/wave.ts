/** The paper's wave, its saturations in profile, held to the float64 reference, and foam amounts by look (docs/formulae.md, sections 2, 4 and 5). */

const TURN = 2 * Math.PI;
const CAP = 4; // Greatest saturation: no look tells greater ones apart
const EXPONENT = 80;
const GRAVITY = 9.81;

/** Constants of a front's saturation f = E^(−tan(θ/2 + δ))/C. */
export interface Front {
  delta: number; // δ: where on the wave the foam begins, rad
  base: number; // E: how steeply the foam rises and falls
  intensity: number; // C: larger values give less foam
}

/** δ and E of the paper's text, and of its listing. */
export const CONSTANTS = {
  text: { delta: Math.PI / 2, base: Math.E },
  listing: { delta: 1.07, base: 2.718 },
} as const;

/** Phase θ of a wave that travels toward +x, in [0, 2π); x and wavelength in m, time in s. */
export function phase(x: number, time: number, wavelength: number): number {
  const turns = time / period(wavelength) - x / wavelength;
  return TURN * (turns - Math.floor(turns));
}

/** Period of a wave in deep water, s. */
export const period = (wavelength: number) => Math.sqrt((TURN * wavelength) / GRAVITY);

/** Height u^K over the trough, as a share of the amplitude. */
export const height = (theta: number, exponent: number) => ((Math.sin(theta) + 1) / 2) ** exponent;

/** Saturation by height (Kryachko 2005), in [0, 4]. */
export const heightSaturation = (height: number, base: number, full: number): number => Math.min(Math.max((height - base) / (full - base), 0), CAP);

/** Saturation of a front (Yingst et al. 2011), in [0, 4]; 4 at the pole, which is approached from behind the front. */
export function frontSaturation(theta: number, { delta, base, intensity }: Front): number {
  let psi = (theta + 2 * delta - Math.PI) % TURN;
  if (psi < 0) psi += TURN;
  if (psi === 0) return CAP;
  const exponent = Math.log(base) / Math.tan(psi / 2);
  return Math.min(Math.exp(Math.min(Math.max(exponent, -EXPONENT), EXPONENT)) / intensity, CAP);
}

export const LOOKS = {
  textured: { title: "Faded texture", formula: "a = f · t" },
  halftone: { title: "Equation 1", formula: "a = 1 where f > m" },
  fading: { title: "Equation 2", formula: "a = f/2 − m where f > m" },
  halftone_textured: { title: "Equation 3", formula: "a = (f/2 − m) · t where f > m" },
  listing: { title: "Listing", formula: "a = max(f − m, 0.15) · t where f > m" },
  filtered: { title: "Filtered", formula: "a = the share of the pixel where f > m" },
} as const;
export type Look = keyof typeof LOOKS;

export const VISIBLE = 0.5 / 255; // Smallest amount that a screen of 8 bits shows

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
  pops = 0; // Since the last call of `advance`
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
