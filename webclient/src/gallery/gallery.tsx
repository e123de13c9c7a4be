/** Gallery of presets: a strip of thumbnails by group, and a list with search and summaries above it. */
import { signal } from "@preact/signals";
import { render } from "preact";
import type { PresetSummary } from "../api";
import { hasModifier } from "../ui/dom";
import { Icon } from "../ui/icons";
import { thumbnailUrl } from "../ui/still";
import { PresetList } from "./list";
import { followsLink, grouped, indexAfter, waterUrl } from "./search";

export class Gallery {
  readonly selected = signal("");
  readonly listOpen = signal(false);
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

  /** Loads the thumbnails that are seen; until then nothing is transferred that the first picture does not need. */
  showPictures(): void {
    this.pictures.value = true;
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
