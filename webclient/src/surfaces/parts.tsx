/** Parts that the surfaces share. */
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useState } from "preact/hooks";
import type { PageContext } from "./context";
import { copyText } from "../ui/dom";
import { Icon } from "../ui/icons";
import "./surface.css";

/** Listens to the page from the first rendering on: an effect would wait for a paint, and miss what comes before it. */
export function useChanges(context: PageContext, listener: () => void): void {
  useLayoutEffect(() => context.onChange(listener), []);
}

export function Head({ title, close }: { title: string; close: () => void }) {
  return (
    <div class="sticky top-0 z-1 -mx-5 flex items-center justify-between border-b border-line bg-sheet p-2 pl-5">
      <h2 class="font-serif text-[22px]/[1.2]">{title}</h2>
      <button type="button" class="plain" aria-label={`Close ${title.toLowerCase()}`} onClick={close}>
        <Icon name="close" />
      </button>
    </div>
  );
}

/** Buttons of which one is chosen. */
export function Pills<T extends string>({ names, chosen, choose }: { names: readonly T[]; chosen: T; choose: (name: T) => void }) {
  return names.map((name) => (
    <button type="button" class="pill" key={name} aria-pressed={name === chosen} onClick={() => choose(name)}>{name}</button>
  ));
}

/** A button that is disabled while its task runs. */
export function TaskButton({ run, children, failed }: { run: () => Promise<void>; children: ComponentChildren; failed: (error: unknown) => void }) {
  const [running, setRunning] = useState(false);
  const start = () => {
    setRunning(true);
    run().catch(failed).finally(() => setRunning(false));
  };
  return <button type="button" class="pill" disabled={running} aria-busy={running} onClick={start}>{children}</button>;
}

/** Text to copy. */
export function CodeBlock({ label, text, failed }: { label: string; text: string; failed: (error: unknown) => void }) {
  const [copied, setCopied] = useState(false);
  const copy = async () => {
    if (!(await copyText(text))) throw new Error("The browser does not copy here. Select the text to copy it.");
    setCopied(true);
    setTimeout(() => setCopied(false), 2000);
  };
  return (
    <div>
      <TaskButton run={copy} failed={failed}>{copied ? "Copied" : `Copy ${label}`}</TaskButton>
      <pre tabIndex={0} aria-label={label}><code>{text}</code></pre>
    </div>
  );
}
