/** A preset's still: the server's own picture of its start, a file, over the canvas until the live water is there. */

/** Where the build has the stills (`make stills`), below the page. */
const FOLDER = "./stills";

/** How long it fades (style.css) and a little more, ms. */
const FADE = 400;
/** Time that the water waits for the still at most, ms. */
const LATE = 800;

export const stillOf = (name: string) => `${FOLDER}/${name}.avif`;
export const thumbnailOf = (name: string) => `${FOLDER}/${name}.small.avif`;

export class Still {
  private fading = 0;
  private wanted: string | null = null;

  /** `image`: shown already where the address asks for a preset's start, see index.html. */
  constructor(private readonly image: HTMLImageElement) {}

  /** Whether anything of it is to be seen. */
  get shown(): boolean {
    return !this.image.hidden;
  }

  /** Resolves when the still is on the screen, or will not be soon: starting GL stops the page for a while. */
  async painted(): Promise<void> {
    if (!this.shown) return;
    const late = new Promise((resolve) => setTimeout(resolve, LATE));
    const frame = () => new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
    await Promise.race([late, this.image.decode().then(frame, () => undefined)]);
  }

  /** Shows a preset's still, once it is there and unless the water is there before it. */
  show(name: string): void {
    this.drop();
    this.wanted = name;
    this.image.classList.remove("lifted");
    this.image.src = stillOf(name);
    // Until then the image would show what it showed before.
    this.image.decode().then(
      () => {
        if (this.wanted === name) this.image.hidden = false;
      },
      () => undefined,
    );
  }

  /** Fades into the water. */
  lift(): void {
    this.wanted = null;
    if (this.image.hidden || this.image.classList.contains("lifted")) return;
    this.image.classList.add("lifted");
    // Where transitions are off, no end is told of.
    this.fading = window.setTimeout(() => this.drop(), FADE);
  }

  /** Takes it away at once: it shows what is no longer asked for. */
  drop(): void {
    this.wanted = null;
    clearTimeout(this.fading);
    this.image.hidden = true;
    document.documentElement.classList.remove("still");
  }
}
