/** Downloads of a mask, and the code that samples it. */
import { useState } from "preact/hooks";
import { type MaskChoice, maskPath } from "./choice";
import type { LoadedMask } from "./data";
import { FORMATS, snippets } from "./snippets";
import { copyText } from "../ui/clipboard";

const UNTESTED = "untested before:content-['⚠_']";
const BUTTON = "block min-h-11 rounded-lg bg-hover px-3.5 py-[11px]";

interface TakeHomeProps {
  choice: MaskChoice;
  loaded: LoadedMask;
  /** The server's address. */
  base: string;
}

export function TakeHome({ choice, loaded: { info, mask }, base }: TakeHomeProps) {
  const url = (resource: string) => new URL(maskPath(choice, resource), base).href;
  const list = snippets(url("data.u16"), mask);
  const [name, setName] = useState("three.js");
  const [copied, setCopied] = useState("");
  const shown = list.find((one) => one.name === name) ?? list[0];
  if (shown === undefined) return null;
  const copy = async () => {
    try {
      await copyText(shown.code);
      setCopied("Copied.");
    } catch {
      setCopied("Clipboard access denied. Select the code to copy it.");
    }
  };
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
            onClick={() => {
              setName(one.name);
              setCopied("");
            }}
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
