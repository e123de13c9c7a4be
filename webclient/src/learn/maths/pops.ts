/** Counts bubbles that pop: whose amount falls from visible to none. */
import { VISIBLE } from "./looks";

export class PopCounter {
  private readonly visible: Uint8Array;
  private pops = 0;

  constructor(bubbles: number) {
    this.visible = new Uint8Array(bubbles);
  }

  /** The amount of one bubble in the present frame. */
  see(bubble: number, amount: number): void {
    const now = amount > VISIBLE ? 1 : 0;
    if (now === 0 && this.visible[bubble] === 1) this.pops++;
    this.visible[bubble] = now;
  }

  /** Pops since the last call. */
  take(): number {
    const { pops } = this;
    this.pops = 0;
    return pops;
  }
}

/** Pops per second over about the last second of motion. */
export class PopRate {
  perSecond = 0;

  constructor(private readonly counter: PopCounter) {}

  /** After a frame that moved time by `seconds`. */
  advance(seconds: number): void {
    const pops = this.counter.take();
    // A jump in time pops bubbles that no clock saw.
    if (seconds <= 0 || seconds > 0.25) return;
    const share = 1 - Math.exp(-seconds);
    this.perSecond += share * (pops / seconds - this.perSecond);
  }
}
