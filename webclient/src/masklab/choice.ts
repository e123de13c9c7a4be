/** A mask to look at: shipped, or made from its parameters; its text in addresses and its path in the API. */

export const FAMILIES = ["vac", "blur", "clump", "bubble", "mix", "lace"] as const;
type Family = (typeof FAMILIES)[number];
/** Of the width and of the height, texels. */
export const SIDE_RANGE = [32, 1024] as const;

/** Least and greatest σ of any family, texels; the server says what a family and a size allow. */
export const SIGMA_RANGE = [0.5, 24] as const;
export const ASPECT_RANGE = [1, 6] as const;
export const SEED_RANGE = [0, 2 ** 32 - 1] as const;

export interface CustomMask {
  family: Family;
  /** Texels. */
  sigma: number;
  width: number;
  height: number;
  seed: number;
  /** Of lace: length of its cells along x over their width, and the age of its foam. */
  aspect: number;
  age: number;
}

/** The name of a shipped mask, or parameters. */
export type MaskChoice = string | CustomMask;

/** `family:sigma:size:seed`, for lace with `:aspect:age`, as in scenes; a size is a side or WIDTHxHEIGHT. */
export function choiceText(choice: MaskChoice): string {
  if (typeof choice === "string") return choice;
  const { family, sigma, width, height, seed, aspect, age } = choice;
  return [family, sigma, width === height ? width : `${width}x${height}`, seed, ...(family === "lace" ? [aspect, age] : [])].join(":");
}

/** Null for what is no mask. */
export function parseChoice(text: string): MaskChoice | null {
  if (/^[a-z][a-z\d.-]{0,39}$/.test(text)) return text;
  const [name, ...rest] = text.split(":");
  const family = FAMILIES.find((one) => one === name);
  const [sigma = NaN, , seed = NaN, aspect = 1, age = 0] = rest.map(Number);
  const [width = NaN, height = width] = (rest[1] ?? "").split("x").map(Number);
  const within = (value: number, [low, high]: readonly [number, number]) => value >= low && value <= high;
  const valid =
    family !== undefined &&
    rest.length === (family === "lace" ? 5 : 3) &&
    within(sigma, SIGMA_RANGE) &&
    [width, height, seed].every(Number.isInteger) &&
    within(width, SIDE_RANGE) &&
    within(height, SIDE_RANGE) &&
    within(seed, SEED_RANGE) &&
    within(aspect, ASPECT_RANGE) &&
    within(age, [0, 1]);
  return valid ? { family, sigma, width, height, seed, aspect, age } : null;
}

/** Path of a resource of the mask, below the server's address. */
export function maskPath(choice: MaskChoice, resource = ""): string {
  const rest = resource === "" ? "" : `/${resource}`;
  if (typeof choice === "string") return `api/masks/${encodeURIComponent(choice)}${rest}`;
  const { family, sigma, width, height, seed, aspect, age } = choice;
  const lace: Record<string, string> = family === "lace" ? { aspect: String(aspect), age: String(age) } : {};
  const query = new URLSearchParams({ family, sigma: String(sigma), width: String(width), height: String(height), seed: String(seed), ...lace });
  return `api/masks/custom${rest}?${query.toString()}`;
}

export interface LabState {
  left: MaskChoice;
  /** Null: one mask alone. */
  right: MaskChoice | null;
  /** Saturation of the pattern; null: the mask itself. */
  grey: number | null;
  show: Show;
}

/** One tile, two by two, or texels enlarged around the corner where four tiles meet. */
export const SHOWS = ["tile", "tiled", "detail"] as const;
export type Show = (typeof SHOWS)[number];

export const START: LabState = { left: "vac-24", right: null, grey: 0.25, show: "tile" };

export function encodeState({ left, right, grey, show }: LabState): string {
  const parts: [string, string][] = [["mask", choiceText(left)]];
  if (right !== null) parts.push(["beside", choiceText(right)]);
  parts.push(["grey", grey === null ? "mask" : String(grey)]);
  if (show !== START.show) parts.push(["show", show]);
  return parts.map(([key, value]) => `${key}=${value}`).join("&");
}

/** What is missing or wrong is as at the start. */
export function decodeState(fragment: string): LabState {
  const parts = new URLSearchParams(fragment.replace(/^#/, ""));
  const text = parts.get("grey");
  const grey = text === null || text === "" ? NaN : Number(text);
  const beside = parts.get("beside");
  return {
    left: parseChoice(parts.get("mask") ?? "") ?? START.left,
    right: beside === null ? null : parseChoice(beside),
    grey: text === "mask" ? null : grey >= 0 && grey <= 1 ? grey : START.grey,
    show: SHOWS.find((show) => show === parts.get("show")) ?? START.show,
  };
}
