/** Downloads of a mask, and code that thresholds it, antialiased: the files of docs/snippets, for any mask. */
import { useState } from "preact/hooks";
import glsl from "../../../docs/snippets/foam.glsl?raw";
import godot from "../../../docs/snippets/godot.gdshader?raw";
import shadertoy from "../../../docs/snippets/shadertoy.glsl?raw";
import three from "../../../docs/snippets/three.js?raw";
import unity from "../../../docs/snippets/unity.hlsl?raw";
import unreal from "../../../docs/snippets/unreal.usf?raw";
import { copyText } from "../ui/dom";
import { type LoadedMask, type Mask, type MaskChoice, maskPath } from "./choice";

interface Snippet {
  name: string;
  file: string | null; // File to download for it; null where it needs none
  tested: boolean; // Whether a test of this project runs it
  note: string;
  code: string;
}

const LEVELS = 11; // Levels of the largest mask
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

const UNTESTED = "untested before:content-['⚠_']";
const BUTTON = "block min-h-11 rounded-lg bg-hover px-3.5 py-[11px]";

/** `base`: the server's address. */
interface TakeHomeProps { choice: MaskChoice; loaded: LoadedMask; base: string; }

export function TakeHome({ choice, loaded: { info, mask }, base }: TakeHomeProps) {
  const url = (resource: string) => new URL(maskPath(choice, resource), base).href;
  const list = snippets(url("data.u16"), mask);
  const [{ name, copied }, set] = useState({ name: "three.js", copied: "" });
  const shown = list.find((one) => one.name === name) ?? list[0];
  if (shown === undefined) return null;
  const copy = async () => set({ name, copied: (await copyText(shown.code)) ? "Copied." : "Clipboard access denied. Select the code to copy it." });
  return (
    <section class="take-home pt-5.5" aria-label="Downloads and code">
      <h2 class="font-serif text-[22px]">{info.title}: files and code</h2>
      <ul class="formats my-2.5 flex flex-wrap gap-2">
        {FORMATS.map(({ resource, title, note }) => (
          <li key={resource}>
            <a class={BUTTON} href={url(resource)} download><b>{title}</b> <span class="text-fine text-soft">{note}</span></a>
          </li>
        ))}
      </ul>
      <div class="flex flex-wrap items-center gap-2" role="group" aria-label="Engine">
        {list.map((one) => (
          <button
            type="button"
            key={one.name}
            class={`${BUTTON} aria-pressed:inset-ring-[1.5px] aria-pressed:inset-ring-accent`}
            aria-pressed={one.name === shown.name}
            onClick={() => set({ name: one.name, copied: "" })}
          >
            {one.name}
          </button>
        ))}
        <button type="button" class={BUTTON} onClick={() => void copy()}>Copy code</button>
        <span role="status">{copied}</span>
      </div>
      <p class={`mt-1 mb-2.5 max-w-[74ch] text-soft ${shown.tested ? "tested" : UNTESTED}`}>
        {shown.note} {shown.file !== null && `File: ${shown.file}. Licence: ${info.license}.`}
      </p>
      <pre class="max-h-[460px] overflow-auto rounded-lg bg-[#0b151e] px-4.5 py-4 text-fine/[1.55]" tabIndex={0} aria-label={`Code for ${shown.name}`}>
        <code>{shown.code}</code>
      </pre>
    </section>
  );
}
