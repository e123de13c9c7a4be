/** Downloads of a mask, and the code that samples it. */
import { useState } from "preact/hooks";
import { type MaskChoice, maskPath } from "./choice";
import type { MaskInfo } from "./data";
import { FORMATS, snippets } from "./snippets";

interface TakeHomeProps {
  choice: MaskChoice;
  info: MaskInfo;
  /** The server's address. */
  base: string;
}

export function TakeHome({ choice, info, base }: TakeHomeProps) {
  const url = (resource: string) => new URL(maskPath(choice, resource), base).href;
  const list = snippets(url("data.u16"), info.parameters.size);
  const [name, setName] = useState("three.js");
  const [copied, setCopied] = useState("");
  const shown = list.find((one) => one.name === name) ?? list[0];
  if (shown === undefined) return null;
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(shown.code);
      setCopied("Copied.");
    } catch {
      setCopied("Clipboard access denied. Select the code to copy it.");
    }
  };
  return (
    <section class="take-home" aria-label="Downloads and code">
      <h2>{info.title}: files and code</h2>
      <ul class="formats">
        {FORMATS.map(({ resource, title, note }) => (
          <li key={resource}>
            <a href={url(resource)} download>
              <b>{title}</b> <span>{note}</span>
            </a>
          </li>
        ))}
      </ul>
      <div class="engines" role="group" aria-label="Engine">
        {list.map((one) => (
          <button
            type="button"
            key={one.name}
            aria-pressed={one.name === shown.name}
            onClick={() => {
              setName(one.name);
              setCopied("");
            }}
          >
            {one.name}
          </button>
        ))}
        <button type="button" class="copy" onClick={() => void copy()}>
          Copy code
        </button>
        <span role="status">{copied}</span>
      </div>
      <p class={shown.tested ? "tested" : "untested"}>
        {shown.note} File: {shown.file}. Licence: {info.license}.
      </p>
      <pre tabIndex={0} aria-label={`Code for ${shown.name}`}>
        <code>{shown.code}</code>
      </pre>
    </section>
  );
}
