/** Colours of the figures, which are dark in both themes. */

export const COLORS = {
  ground: "#06121b",
  water: "#123a4e",
  crest: "#4d9bb8",
  foam: "#f2f7f6",
  saturation: "#f3c795",
  other: "#86d3c0",
  faint: "rgb(200 224 234 / 22%)",
  text: "rgb(214 230 236 / 82%)",
  unlit: "#31566a",
} as const;

const WATER = [10, 40, 56] as const;
const FOAM = [242, 247, 246] as const;

const encoded = (linear: number) => 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);
const decoded = (byte: number) => (byte / 255 <= 0.04045 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);

/** Foam over water by the amount in 255ths, blended in linear light; as the words of `ImageData`. */
export const BLEND = Uint32Array.from({ length: 256 }, (_, i) => {
  const a = i / 255;
  const [r = 0, g = 0, b = 0] = WATER.map((water, c) => Math.round(encoded((1 - a) * decoded(water) + a * decoded(FOAM[c] ?? 0))));
  return (255 << 24) | (b << 16) | (g << 8) | r;
});

/** Greys by a threshold in 255ths. */
export const GREYS = Uint32Array.from({ length: 256 }, (_, i) => (255 << 24) | (i << 16) | (i << 8) | i);

/** The word of a colour scale at a share of it. */
export function shade(scale: Uint32Array, share: number): number {
  return scale[Math.min(255, Math.max(0, Math.round(255 * share)))] ?? 0;
}
