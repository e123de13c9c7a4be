/** Lowers the resolution where frames take too long, and raises it again where there is room. */

const SLOW = 50;
const FAST = 22;
const LEAST = 0.25;
/** Frames that must agree before the scale moves up. */
const PATIENCE = 12;
/** First frames of a picture, which the driver may spend on compiling. */
const WARM_UP = 2;

export class Resolution {
  private easy = 0;
  /** A scale that turned out too slow is not tried again until the picture changes. */
  private ceiling = 1;
  private cold = WARM_UP;

  constructor(private value = 1) {}

  get scale(): number {
    return this.value;
  }

  /** Takes one frame's time; says whether the scale moved. */
  frame(milliseconds: number): boolean {
    if (this.cold > 0) {
      this.cold -= 1;
      return false;
    }
    if (milliseconds > SLOW && this.value > LEAST) {
      this.ceiling = this.value * 0.95;
      this.value = Math.max(LEAST, this.value * Math.max(0.5, Math.sqrt((0.8 * SLOW) / milliseconds)));
      this.easy = 0;
      return true;
    }
    this.easy = milliseconds < FAST ? this.easy + 1 : 0;
    if (this.easy < PATIENCE || this.value >= this.ceiling) return false;
    this.easy = 0;
    this.value = Math.min(this.ceiling, this.value * 1.2);
    return true;
  }

  /** The picture became another one: what was too slow may be fast now. */
  reconsider(): void {
    this.ceiling = 1;
    this.cold = WARM_UP;
  }

  /** Whether a frame's time would tell nothing yet. */
  get warmingUp(): boolean {
    return this.cold > 0;
  }
}
