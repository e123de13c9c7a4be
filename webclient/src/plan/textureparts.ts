/** Textures of 16 bits in two parts: by the upper one, which is small, water is drawn before the lower one is asked for. */
import type { FramePlan, Texture } from "../generated/api";
import type { LoadBytes, RoughTextures } from "./executor";

/** As the server cuts them (textures/store.py). */
const UPPER_BITS = 6;
const LOWER_BITS = 16 - UPPER_BITS;

type Load = (spec: Texture, part?: "upper" | "lower") => Promise<ArrayBuffer>; // Loads a texture, or a part of it

/**
 * Names of the textures that a plan's first pictures can do with the upper bits of. Setup passes make tables of means of them,
 * in which the lower bits hardly show; what a frame reads itself it may compare texel by texel.
 */
export function roughTextures({ textures, passes }: Pick<FramePlan, "textures" | "passes">): Set<string> {
  const names = new Set(Object.keys(textures).filter((name) => textures[name]?.format === "R16UI"));
  for (const { when, inputs } of passes) {
    if (when === "setup") continue;
    for (const input of Object.values(inputs ?? {})) if ("texture" in input) names.delete(input.texture);
  }
  return names;
}

/** Loads textures, roughly at first; what of one is here is not asked for again. */
export class TextureParts {
  /** Upper parts whose lower parts are not here yet, by the texture's hash. */
  private readonly upper = new Map<string, Promise<Uint8Array>>();

  constructor(private readonly load: Load) {}

  /** What a plan's first pictures can do with; null: they need all of every texture. */
  roughOf(plan: Pick<FramePlan, "textures" | "passes">): RoughTextures | null {
    const names = roughTextures(plan);
    return names.size === 0 ? null : { names, bytes: this.rough };
  }

  /** Texels by their upper bits, as if the lower ones were half of what they can be. */
  private readonly rough: LoadBytes = async (spec) => {
    const texels = Uint16Array.from(await this.upperOf(spec), (upper) => (upper << LOWER_BITS) | (1 << (LOWER_BITS - 1)));
    return texels.buffer;
  };

  readonly exact: LoadBytes = async (spec) => {
    const known = this.upper.get(spec.sha256);
    if (known === undefined) return this.load(spec);
    const [upper, lower] = await Promise.all([known, this.load(spec, "lower")]);
    this.upper.delete(spec.sha256);
    return joined(upper, new Uint8Array(lower)).buffer;
  };

  private upperOf(spec: Texture): Promise<Uint8Array> {
    const known = this.upper.get(spec.sha256);
    if (known !== undefined) return known;
    const upper = this.load(spec, "upper").then((coded) => decoded(new Uint8Array(coded), spec.width));
    this.upper.set(spec.sha256, upper);
    upper.catch(() => this.upper.delete(spec.sha256));
    return upper;
  }
}

/** Upper bits from what is to be added to the median of the texel before, the one above, and their sum less the one between them. */
export function decoded(coded: Uint8Array, width: number): Uint8Array<ArrayBuffer> {
  const values = new Uint8Array(coded.length);
  const most = (1 << UPPER_BITS) - 1;
  for (let i = 0; i < values.length; i++) {
    const first = i % width === 0;
    const before = first ? 0 : (values[i - 1] ?? 0);
    const above = values[i - width] ?? 0;
    let expected = before + above;
    if (!first && i >= width) expected = Math.max(Math.min(before, above), Math.min(Math.max(before, above), expected - (values[i - width - 1] ?? 0)));
    values[i] = (expected + (coded[i] ?? 0)) & most;
  }
  return values;
}

/** Texels from upper bits and the lower part: the lowest 8 bits of each texel, then the 2 above, four texels to a byte. */
export function joined(upper: Uint8Array, lower: Uint8Array): Uint16Array<ArrayBuffer> {
  const pairs = lower.subarray(upper.length);
  return Uint16Array.from(upper, (value, i) => (value << LOWER_BITS) | ((((pairs[i >> 2] ?? 0) >> (2 * (i & 3))) & 3) << 8) | (lower[i] ?? 0));
}
