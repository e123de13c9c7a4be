/** The list of all waters: title and summary by group, found by words. */
import { useSignal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import type { PresetSummary } from "../api";
import { grouped, indexAfter, matching } from "./search";
import { followsLink, waterUrl } from "./water";

interface ListProps {
  presets: readonly PresetSummary[];
  selected: { value: string };
  open: { value: boolean };
  choose: (name: string) => void;
  close: () => void;
}

export function PresetList({ presets, selected, open, choose, close }: ListProps) {
  const query = useSignal("");
  const input = useRef<HTMLInputElement>(null);
  useLayoutEffect(() => {
    if (!open.value) return;
    query.value = "";
    input.current?.focus();
  }, [open.value]);
  if (!open.value) return null;
  const found = matching(presets, query.value);
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.key === "Escape") {
      event.preventDefault();
      close();
      return;
    }
    const inSearch = event.target === input.current;
    // In the search field the horizontal keys move the caret.
    if (inSearch && !["ArrowDown", "ArrowUp"].includes(event.key)) return;
    const links = [...(event.currentTarget as HTMLElement).querySelectorAll<HTMLElement>("li a")];
    const from = links.findIndex((each) => each === document.activeElement);
    const index = indexAfter(event.key, from, links.length);
    if (index === null) return;
    event.preventDefault();
    if (from === 0 && event.key === "ArrowUp") input.current?.focus();
    else links[index]?.focus();
  };
  const submit = (event: Event) => {
    event.preventDefault();
    const [first] = found;
    if (first) choose(first.name);
  };
  return (
    <section id="waters" class="waters" aria-label="All waters" onKeyDown={onKeyDown}>
      <form role="search" onSubmit={submit}>
        <input
          ref={input}
          type="search"
          aria-label="Search waters"
          placeholder="Search: storm, lace, caustics…"
          autocomplete="off"
          value={query.value}
          onInput={(event) => (query.value = event.currentTarget.value)}
        />
        <output aria-live="polite">{found.length === 1 ? "1 water" : `${found.length} waters`}</output>
        <button type="button" class="plain" aria-label="Close the list" onClick={close}>
          <svg viewBox="0 0 24 24" aria-hidden="true">
            <path d="M6.500 6.500l11 11M17.500 6.500l-11 11" />
          </svg>
        </button>
      </form>
      <div class="results">
        {found.length === 0 && <p>No water has all of these words.</p>}
        {grouped(found).map(({ heading, presets: members }) => (
          <section key={heading} aria-label={heading}>
            <h2>{heading}</h2>
            <ul>
              {members.map(({ name, title, summary }) => (
                <li key={name}>
                  <a
                    href={waterUrl(name)}
                    aria-current={selected.value === name ? "true" : undefined}
                    onClick={(event) => followsLink(event) || choose(name)}
                  >
                    <b>{title}</b> <span>{summary}</span>
                  </a>
                </li>
              ))}
            </ul>
          </section>
        ))}
      </div>
    </section>
  );
}
