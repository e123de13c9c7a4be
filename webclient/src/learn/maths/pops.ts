/** Counts bubbles that pop: whose amount falls from visible to none. */
import { VISIBLE } from "./looks";

export class PopCounter {
  /** Since the last call of `advance`. */
  pops = 0;
  private perSecond = 0;
  private readonly visible: Uint8Array;

  constructor(bubbles: number) {
    this.visible = new Uint8Array(bubbles);
  }

  /** The amount of one bubble in the present frame. */
  see(bubble: number, amount: number): void {
    const now = amount > VISIBLE ? 1 : 0;
    if (now === 0 && this.visible[bubble] === 1) this.pops++;
    this.visible[bubble] = now;
  }

  /** After a frame that moved time by `seconds`; returns the rate over about the last second of motion, in words. */
  advance(seconds: number): string {
    // A jump in time pops bubbles that no clock saw.
    if (seconds > 0 && seconds <= 0.25) this.perSecond += (1 - Math.exp(-seconds)) * (this.pops / seconds - this.perSecond);
    this.pops = 0;
    return `${Math.round(this.perSecond).toLocaleString("en")} pops/s`;
  }
}
