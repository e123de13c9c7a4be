/** The paper's wave and its saturations in profile (docs/formulae.md, sections 2 and 4); held to the float64 reference. */

const TURN = 2 * Math.PI;
/** Greatest saturation: no look tells greater ones apart. */
const CAP = 4;
const EXPONENT = 80;
const GRAVITY = 9.81;

/** Constants of a front's saturation f = E^(−tan(θ/2 + δ))/C. */
export interface Front {
  /** δ: where on the wave the foam begins, rad. */
  delta: number;
  /** E: how steeply the foam rises and falls. */
  base: number;
  /** C: larger values give less foam. */
  intensity: number;
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
export function heightSaturation(height: number, base: number, full: number): number {
  return Math.min(Math.max((height - base) / (full - base), 0), CAP);
}

/** Saturation of a front (Yingst et al. 2011), in [0, 4]; 4 at the pole, which is approached from behind the front. */
export function frontSaturation(theta: number, { delta, base, intensity }: Front): number {
  let psi = (theta + 2 * delta - Math.PI) % TURN;
  if (psi < 0) psi += TURN;
  if (psi === 0) return CAP;
  const exponent = Math.log(base) / Math.tan(psi / 2);
  return Math.min(Math.exp(Math.min(Math.max(exponent, -EXPONENT), EXPONENT)) / intensity, CAP);
}
