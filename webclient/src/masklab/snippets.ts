/** Code that thresholds a mask, antialiased: the files of docs/snippets, for any mask. */
import glsl from "../../../docs/snippets/foam.glsl?raw";
import godot from "../../../docs/snippets/godot.gdshader?raw";
import shadertoy from "../../../docs/snippets/shadertoy.glsl?raw";
import three from "../../../docs/snippets/three.js?raw";
import unity from "../../../docs/snippets/unity.hlsl?raw";
import unreal from "../../../docs/snippets/unreal.usf?raw";
import type { Mask } from "./pattern";

interface Snippet {
  name: string;
  /** File to download for it; null where it needs none. */
  file: string | null;
  /** Whether a test of this project runs it. */
  tested: boolean;
  note: string;
  code: string;
}

/** Levels of the largest mask. */
const LEVELS = 11;
/** The same of the mask of docs/snippets, as its files have them. */
const SPREADS = "0.0, 0.404, 0.471, 0.493, 0.499, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5";

/** √3 times the root mean square deviation of the thresholds in a texel of each level; of the whole mask, 1/2. */
export function spreads({ width, height, values }: Mask): number[] {
  let level = Float64Array.from(values, (value) => (value + 0.5) / 65536);
  let [w, h] = [width, height];
  const square = () => level.reduce((sum, value) => sum + value * value, 0) / level.length;
  const whole = square();
  return Array.from({ length: LEVELS }, (_, number) => {
    if (number > 0) {
      const [from, before, rows] = [level, w, h];
      [w, h] = [Math.max(w >> 1, 1), Math.max(h >> 1, 1)];
      const at = (x: number, y: number) => from[Math.min(y, rows - 1) * before + Math.min(x, before - 1)] ?? 0;
      level = Float64Array.from({ length: w * h }, (_value, i) => {
        const [x, y] = [2 * (i % w), 2 * Math.floor(i / w)];
        return (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1)) / 4;
      });
    }
    return Math.sqrt(3 * Math.max(whole - square(), 0));
  });
}

/** `url`: of the raw mask. */
export function snippets(url: string, mask: Mask): Snippet[] {
  const own = spreads(mask).map((value) => String(Math.round(1000 * value) / 1000).replace(/^\d+$/, "$&.0"));
  const sides = `${mask.width}, ${mask.height}`;
  const here = (text: string) => text.replace(SPREADS, own.join(", ")).replace("256, 256", sides);
  const loaded = `url = ${JSON.stringify(url)}, width = ${mask.width}, height = ${mask.height}`;
  const tested = { tested: true, note: "Run in this project's tests, its pixels compared with 256 samples a pixel." };
  const untested = { tested: false, note: "Written for the engine's published interface; not run here." };
  return [
    { name: "three.js", file: "data.u16", ...tested, code: here(three).replace('url = "mask.u16", width = 256, height = 256', () => loaded) },
    { name: "Godot", file: "data.u16", ...untested, code: here(godot) },
    { name: "Unity", file: "data.u16", ...untested, code: here(unity) },
    { name: "Unreal", file: "data.png", ...untested, code: here(unreal) },
    { name: "Shadertoy", file: null, ...tested, code: shadertoy },
    { name: "GLSL", file: "data.u16", ...tested, code: here(glsl) },
  ];
}

/** Every form in which the server gives a mask. */
export const FORMATS = [
  { resource: "data.png", title: "16-bit PNG", note: "floor(rank 65536 / N)" },
  { resource: "data.u16", title: "raw", note: "uint16, little-endian" },
  { resource: "data.npy", title: "NumPy", note: "float32 (rank + 0.5) / N" },
  { resource: "data.dds", title: "DDS", note: "R16_UNORM" },
  { resource: "data8.png", title: "8-bit PNG", note: "for quick use" },
  { resource: "sidecar", title: "JSON", note: "parameters, hash, spectrum" },
] as const;
