/** The list of all waters: title and summary by group, found by words. */
import { useSignal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import type { PresetSummary } from "../api";
import { Icon } from "../ui/icons";
import { followsLink, grouped, indexAfter, matching, waterUrl } from "./search";

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
    <section id="waters" class="waters fixed bottom-over-bar left-left z-4 flex max-h-[min(540px,100dvh-168px-2*var(--spacing-gap))] w-[min(560px,var(--spacing-inner))] flex-col rounded-panel border border-line bg-[#09131c] phone:inset-x-gap phone:top-top phone:bottom-bottom phone:z-6 phone:max-h-none phone:w-auto" aria-label="All waters" onKeyDown={onKeyDown}>
      {/* The whole row shows the focus of its field. */}
      <form role="search" class="flex flex-none items-center gap-2 border-b border-line py-1.5 pr-1.5 pl-4.5 has-[input:focus-visible]:rounded-t-panel has-[input:focus-visible]:inset-ring-2 has-[input:focus-visible]:inset-ring-accent" onSubmit={submit}>
        <input
          ref={input}
          type="search"
          class="h-11 min-w-0 flex-1 placeholder:text-soft focus-visible:outline-0"
          aria-label="Search waters"
          placeholder="Search: storm, lace, caustics…"
          autocomplete="off"
          value={query.value}
          onInput={(event) => (query.value = event.currentTarget.value)}
        />
        <output class="text-small text-soft" aria-live="polite">{found.length === 1 ? "1 water" : `${found.length} waters`}</output>
        <button type="button" class="plain" aria-label="Close the list" onClick={close}><Icon name="close" /></button>
      </form>
      <div class="scroller px-2 pt-1 pb-3">
        {found.length === 0 && <p class="my-3.5 px-2.5 text-soft">No water has all of these words.</p>}
        {grouped(found).map(({ heading, presets: members }) => (
          <section key={heading} aria-label={heading}>
            <h2 class="mx-2.5 mt-3.5 mb-1 text-tiny/[1.3] font-medium tracking-[0.08em] text-soft uppercase">{heading}</h2>
            <ul>
              {members.map(({ name, title, summary }) => (
                <li key={name}>
                  <a
                    class="block min-h-11 rounded-md px-2.5 py-[7px] hover:bg-hover focus-visible:-outline-offset-2 aria-[current=true]:shadow-[inset_3px_0_0_var(--color-accent)] forced-colors:aria-[current=true]:outline-3 forced-colors:aria-[current=true]:outline-[Highlight]"
                    href={waterUrl(name)}
                    aria-current={selected.value === name ? "true" : undefined}
                    onClick={(event) => followsLink(event) || choose(name)}
                  >
                    <b class="block font-medium">{title}</b> <span class="block text-fine text-soft">{summary}</span>
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
