/** Gallery of presets: their addresses `water/NAME` below the page's root, a strip of thumbnails by group, and a list of all waters above it, found by words. */
import { signal, useSignal } from "@preact/signals";
import { render } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";
import type { PresetSummary } from "../api";
import { hasModifier } from "../ui/dom";
import { Icon } from "../ui/icons";
import { thumbnailUrl } from "../ui/still";

const FOLDER = "water/";
const PATH = /\/water\/([\w-]+)$/;

/** Address of a preset. The server gives it title, description and picture. */
export const waterUrl = (name: string) => new URL(FOLDER + encodeURIComponent(name), document.baseURI).href;

/** The preset that a path names, or null. */
export const presetOfPath = (pathname: string) => PATH.exec(pathname)?.[1] ?? null;

/** Whether a click on a link is for the browser, such as for a new tab; otherwise its default is prevented. */
function followsLink(event: MouseEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return true;
  event.preventDefault();
  return false;
}

/** Presets that contain every word of the query in title, summary, group, name or effects, in the order of the list. */
export function matching(presets: readonly PresetSummary[], query: string): PresetSummary[] {
  const words = plain(query).split(/\s+/).filter(Boolean);
  return presets.filter(({ name, group, title, summary, effects }) => {
    const text = plain([name, group, title, summary, ...effects].join(" ").replaceAll("_", " "));
    return words.every((word) => text.includes(word));
  });
}

/** Consecutive presets of one group. */
export function grouped(presets: readonly PresetSummary[]): { heading: string; presets: PresetSummary[] }[] {
  const groups: ReturnType<typeof grouped> = [];
  for (const preset of presets) {
    const last = groups.at(-1);
    if (last?.heading === preset.group) last.presets.push(preset);
    else groups.push({ heading: preset.group, presets: [preset] });
  }
  return groups;
}

const STEPS: Readonly<Record<string, number>> = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1, Home: -Infinity, End: Infinity };

/** Index that a key goes to in a list, or null if the key does not move; `from` is -1 before the list. */
export function indexAfter(key: string, from: number, count: number): number | null {
  const step = STEPS[key];
  return step === undefined || count === 0 ? null : Math.min(count - 1, Math.max(0, from + step));
}

/** Lower case without accents. */
const plain = (text: string) => text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();

interface ListProps {
  presets: readonly PresetSummary[];
  selected: { value: string };
  open: { value: boolean };
  choose: (name: string) => void;
  close: () => void;
}

function PresetList({ presets, selected, open, choose, close }: ListProps) {
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

export class Gallery {
  readonly selected = signal("");
  readonly listOpen = signal(false);
  /** Whether thumbnails are loaded where they are seen: until then nothing is transferred that the first picture does not need. */
  readonly pictures = signal(false);

  /** `container`: of the strip; `listContainer`: of the list, which is hidden until it is opened. */
  constructor(
    private readonly container: HTMLElement,
    listContainer: HTMLElement,
    readonly presets: readonly PresetSummary[],
    private readonly onChoose: (name: string) => void,
  ) {
    render(<Strip gallery={this} />, container);
    render(
      <PresetList presets={presets} selected={this.selected} open={this.listOpen} choose={this.choose} close={() => this.toggleList(false)} />,
      listContainer,
    );
    document.addEventListener("keydown", (event) => {
      const typing = event.target instanceof HTMLElement && event.target.matches("input, select, textarea");
      if (event.key !== "/" || typing || hasModifier(event)) return;
      event.preventDefault();
      this.toggleList(true);
    });
  }

  select(name: string): void {
    if (this.selected.value === name) return;
    this.selected.value = name;
    // Preact updates the attributes in a later task; the place of the thumbnail does not depend on them.
    const thumbnail = this.container.querySelector<HTMLElement>(`[data-preset="${CSS.escape(name)}"]`);
    const strip = thumbnail?.closest<HTMLElement>(".strip");
    if (thumbnail && strip) strip.scrollLeft = thumbnail.offsetLeft - (strip.clientWidth - thumbnail.offsetWidth) / 2;
  }

  toggleList(open: boolean): void {
    if (this.listOpen.value === open) return;
    this.listOpen.value = open;
    if (!open) this.container.querySelector<HTMLElement>(".open-list")?.focus();
  }

  readonly choose = (name: string): void => {
    this.listOpen.value = false;
    this.onChoose(name);
  };
}

const THUMBNAIL =
  "group relative h-19 w-[clamp(120px,(100vw-2*var(--spacing-gap)-134px)/9,136px)] flex-none rounded-lg bg-[#16293a] aria-selected:outline-2 aria-selected:outline-accent " +
  "focus-visible:outline-3 focus-visible:outline-ink phone:h-[66px] phone:w-28 forced-colors:aria-selected:outline-3 forced-colors:aria-selected:outline-[Highlight]";

function Strip({ gallery }: { gallery: Gallery }) {
  const { presets, selected, listOpen, pictures, choose } = gallery;
  const moveFocus = (event: KeyboardEvent) => {
    const options = [...(event.currentTarget as HTMLElement).querySelectorAll<HTMLElement>("[role=option]")];
    const index = indexAfter(event.key, options.findIndex((option) => option === document.activeElement), options.length);
    if (index === null || hasModifier(event)) return;
    options[index]?.focus();
    event.preventDefault();
  };
  // One option is in the tab order: the selected one, from which the arrow keys go on.
  const tabStop = presets.some(({ name }) => name === selected.value) ? selected.value : presets[0]?.name;
  return (
    <>
      <button
        type="button"
        class="round open-list"
        title="Search and list all waters (/)"
        aria-label="Search and list all waters"
        aria-expanded={listOpen.value}
        aria-controls="waters"
        onClick={() => gallery.toggleList(true)}
      >
        <Icon name="search" />
      </button>
      <div class="strip -mr-gap flex min-w-0 scroll-px-gap gap-2.5 overflow-x-auto scroll-smooth py-1 pr-gap pl-1 will-change-transform contain-layout contain-paint contain-style [scrollbar-width:none] [&::-webkit-scrollbar]:hidden motion-reduce:scroll-auto" role="listbox" aria-label="Presets" onKeyDown={moveFocus}>
        {grouped(presets).map(({ heading, presets: members }) => (
          // Engines differ in the width that a nested flex container may shrink to: groups and thumbnails do not shrink.
          <div role="group" class="flex flex-none gap-2.5" aria-label={heading} key={heading}>
            <em aria-hidden="true" class="max-h-19 flex-none rotate-180 self-center rounded-md bg-panel [padding:6px_3px] text-center text-[10px]/[1.3] tracking-[0.08em] text-balance text-soft not-italic uppercase [writing-mode:vertical-rl]">{heading}</em>
            {members.map(({ name, title, summary }) => (
              <a
                key={name}
                class={THUMBNAIL}
                href={waterUrl(name)}
                role="option"
                data-preset={name}
                title={summary}
                aria-selected={selected.value === name}
                tabIndex={name === tabStop ? 0 : -1}
                onClick={(event) => followsLink(event) || choose(name)}
              >
                <img class="size-full rounded-lg object-cover outline-line group-hover:outline-2" src={pictures.value ? thumbnailUrl(name) : undefined} alt="" width={240} height={135} loading="lazy" decoding="async" />
                <span class="absolute inset-x-0 bottom-0 rounded-b-lg bg-[rgb(3_9_14/58%)] px-2 pt-[5px] pb-1.5 text-small/[1.15] text-balance">{title}</span>
              </a>
            ))}
          </div>
        ))}
      </div>
    </>
  );
}
