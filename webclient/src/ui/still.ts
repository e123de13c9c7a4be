/** A preset's still: the server's picture of its first moment, shown over the canvas until the first frame. */

const FOLDER = "./stills"; // Written by `make stills`

const FADE = 400; // A little longer than the transition in index.html, ms
const PAINT_TIMEOUT = 800;
/** Animation frames until a browser that paints without a GPU has put the still on the screen: before, it has no time for WebGL. */
const FRAMES = 4;

export const stillUrl = (name: string) => `${FOLDER}/${name}.avif`;
export const thumbnailUrl = (name: string) => `${FOLDER}/${name}.small.webp`;

export class StillImage {
  private fadeTimer = 0;
  private requested: string | null = null;

  /** `image`: shown already if the link is to a preset's start, see index.html. */
  constructor(private readonly image: HTMLImageElement) {}

  get shown(): boolean { return !this.image.hidden; }

  /** Resolves when the still is on the screen, at the latest after a timeout: starting WebGL blocks the page for a while. */
  async whenPainted(): Promise<void> {
    if (!this.shown) return;
    const timeout = new Promise((resolve) => setTimeout(resolve, PAINT_TIMEOUT));
    const nextFrame = () => new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
    const frames = async (left = FRAMES): Promise<void> => (left > 0 ? nextFrame().then(() => frames(left - 1)) : undefined);
    await Promise.race([timeout, this.image.decode().then(() => frames(), () => undefined)]);
  }

  /** Shows a preset's still once it is decoded, unless the first frame is earlier. */
  show(name: string): void {
    this.hide();
    this.requested = name;
    this.image.classList.remove("faded");
    this.image.src = stillUrl(name);
    this.image.decode().then(
      () => {
        if (this.requested === name) this.image.hidden = false;
      },
      () => undefined,
    );
  }

  fadeOut(): void {
    this.requested = null;
    if (this.image.hidden || this.image.classList.contains("faded")) return;
    this.image.classList.add("faded");
    // Without transitions there is no transitionend event.
    this.fadeTimer = window.setTimeout(() => this.hide(), FADE);
  }

  hide(): void {
    this.requested = null;
    clearTimeout(this.fadeTimer);
    this.image.hidden = true;
    document.documentElement.classList.remove("still");
  }
}
