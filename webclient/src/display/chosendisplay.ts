/** Chooses who draws, by what each was measured to give: this browser, or the server frame by frame. */
import type { Display, DisplayEvents, FrameSource, FrameSourceChoice, FrameTiming, Rate, ViewState } from "./display";
import type { PlanLoader } from "./planloader";
import type { ServerView } from "./serverview";
import type { Viewport } from "./viewport";

/** Frames a second, and the scale, below which a picture counts for less: it stutters, or is a smear. */
const FLUENT = { fps: 8, scale: 0.4 };
const LEAST = { fps: 2.5, scale: 0.2 }; // Below these it is no moving picture
const BETTER = 1.2; // The other is taken if it gives more than this multiple
const AGAIN = 60_000; // Time after which the one that was left is tried again, ms
const HEAD_START = 1500; // Time that this browser has for its first plan before the server draws meanwhile, ms
const SECOND_LOOK = 5000; // Time after which a browser that seemed slow while the page opened is looked at again, ms
const PATIENCE = 1500; // Time for which this browser's picture may be less than good before the server is tried, ms

/** Share of the window's pixels a second; less where it stutters or is a smear, 0 where it is no moving picture. */
export function worth(rate: Rate | null): number {
  if (rate === null || rate.fps < LEAST.fps || rate.scale < LEAST.scale) return 0;
  const [fluent, sharp] = [Math.min(1, rate.fps / FLUENT.fps), Math.min(1, rate.scale / FLUENT.scale)];
  return rate.scale ** 2 * rate.fps * fluent * sharp;
}

const isGood = ({ fps, scale }: Rate) => fps >= FLUENT.fps && scale >= FLUENT.scale;

export class ChosenDisplay {
  private chosen: FrameSource; // Who draws for good; the server may do so meanwhile
  /** Since when this browser compiles its first plan, ms of performance.now(); null while it does not. */
  private waitsSince: number | null = null;
  private meanwhile = false; // Whether the server draws until this browser is ready
  private rates: Record<FrameSource, Rate | null> = { browser: null, server: null };
  private slow: Promise<boolean> | null = null; // Whether this browser draws slowly, once it is asked
  private lookedAgain = false;
  private tryAt = 0; // When the one that does not draw may be tried, ms of performance.now()
  private goodAt = 0; // When this browser's picture was good, or not yet measured
  choice: FrameSourceChoice = "auto"; // Who draws, as the user wishes; set by `choose`

  /** `browser`: null, with the reason, where it cannot draw. */
  constructor(
    readonly browser: Viewport | null,
    private readonly server: ServerView,
    private readonly cannot: string | null,
    private readonly events: DisplayEvents,
  ) {
    this.chosen = browser === null ? "server" : "browser";
  }

  /** What draws for good. */
  get current(): Display {
    return this.chosen === "browser" && this.browser !== null ? this.browser : this.server;
  }

  get source(): FrameSource { return this.meanwhile ? "server" : this.chosen; }

  /** Settles when it is known who draws the first picture: one that moves is the server's where this browser is slow. */
  async decide(moving: boolean): Promise<void> {
    const { browser } = this;
    const open = () => moving && browser?.blank === true && this.chosen === "browser" && this.choice === "auto";
    if (browser === null || !open()) return;
    this.slow ??= browser.slow();
    if (!(await this.slow) || !open()) return;
    this.tryAt = performance.now() + SECOND_LOOK;
    this.use("server");
  }

  /** Draws as the user wishes. */
  choose(choice: FrameSourceChoice): void {
    this.choice = choice;
    this.rates = { browser: null, server: null };
    this.tryAt = 0;
    if (choice === "browser" && this.meanwhile) this.endBridge();
    if (choice !== "auto") this.use(choice);
  }

  /** Who draws and why, as a sentence. */
  get why(): string {
    const { cannot, source, choice } = this;
    const { stalled } = this.current;
    if (this.meanwhile) return "The server draws the frames until this browser is ready.";
    if (stalled !== null) return `The picture stands still: ${stalled}.`;
    if (cannot !== null) return `The server draws the frames. ${cannot}`;
    if (choice !== "auto") return source === "server" ? "The server draws the frames, as you chose." : "This browser draws, as you chose.";
    return source === "server" ? "The server draws the frames: this browser would draw fewer pixels a second." : "This browser draws.";
  }

  /** This browser's canvas, if it draws. */
  get viewport(): Viewport | null { return this.chosen === "browser" ? this.browser : null; }

  /** The picture is out of date. */
  invalidate(): void {
    this.current.dirty = true;
    if (this.meanwhile) this.server.dirty = true;
  }

  get blank(): boolean { return this.current.blank && this.server.blank; }

  get presentable(): boolean { return (this.current.presentable && !this.leaves) || this.bridged; }

  /** Whether the server's picture stands while this browser compiles. */
  get bridged(): boolean { return this.meanwhile && this.server.presentable; }

  setFixedScale(scale: number | null): void {
    this.browser?.setFixedScale(scale);
    this.server.setFixedScale(scale);
  }

  tick(now: number, view: ViewState, moving: boolean): void {
    this.reconsider(performance.now());
    this.current.tick(now, view, moving);
    this.bridge(now, view, moving);
    // The server's last picture stays until the first of this browser.
    if (this.chosen === "browser" && !this.meanwhile && !this.server.blank && this.current.presentable) this.server.hide();
  }

  timing(): FrameTiming {
    return this.meanwhile ? this.server.timing() : this.current.timing();
  }

  planChanged(cost: number): void {
    const { browser } = this.rates;
    // What this browser would give now is not measured again before the server draws less.
    this.rates = { browser: browser && { ...browser, fps: browser.fps / cost }, server: null };
    this.current.planChanged(cost);
  }

  /** Has the server draw while this browser takes long to compile its first plan, until its picture is good. */
  private bridge(now: number, view: ViewState, moving: boolean): void {
    if (this.chosen !== "browser" || this.choice !== "auto" || this.browser === null) return;
    if (!this.browser.blank) this.waitsSince = null;
    else if (moving) {
      this.waitsSince ??= now;
      this.meanwhile ||= now - this.waitsSince > HEAD_START;
    }
    if (!this.meanwhile) return;
    if (this.browser.presentable || this.server.stalled !== null) this.endBridge();
    else this.server.tick(now, view, moving);
  }

  private endBridge(): void {
    this.meanwhile = false;
    this.server.close();
  }

  /** Whether this browser gives so little that the server is tried: nothing that moves, or for some time no good picture. */
  private get leaves(): boolean {
    const rate = this.chosen === "browser" && this.choice === "auto" ? this.current.rate() : null;
    const now = performance.now();
    if (rate === null || isGood(rate)) this.goodAt = now;
    return rate !== null && now >= this.tryAt && (worth(rate) === 0 || now - this.goodAt > PATIENCE);
  }

  private reconsider(now: number): void {
    const { browser, choice, current, chosen, rates, server } = this;
    if (browser === null || choice !== "auto") return;
    rates[chosen] = current.rate() ?? rates[chosen];
    if (chosen === "browser") {
      if (this.leaves) this.use("server");
    } else if (server.stalled !== null) {
      this.tryAt = server.retryAt;
      if (rates.browser === null || worth(rates.browser) > 0) this.use("browser");
    } else if (current.rate() !== null && this.browserGivesMore) {
      this.tryAt = now + AGAIN;
      this.use("browser");
    } else if (this.slow !== null && rates.browser === null && !this.lookedAgain && now >= this.tryAt) {
      this.lookedAgain = true;
      void this.lookAgain(browser);
    }
  }

  private async lookAgain(browser: Viewport): Promise<void> {
    if (!(await browser.slow()) && this.choice === "auto") this.use("browser");
  }

  /** Whether this browser, if it is not slow or is measured, draws more than the server does; anything is more than nothing that moves. */
  private get browserGivesMore(): boolean {
    const { browser, server } = this.rates;
    return browser === null ? worth(server) === 0 : worth(browser) > BETTER * worth(server);
  }

  private use(source: FrameSource): void {
    if (source === this.chosen || (source === "browser" && this.browser === null)) return;
    if (this.chosen === "server") this.server.close();
    this.chosen = source;
    this.meanwhile = false;
    this.current.planChanged(1);
    this.events.sourceChanged();
  }
}

export type MakeDisplay = (loaders: readonly [PlanLoader, PlanLoader], events: DisplayEvents) => ChosenDisplay;
