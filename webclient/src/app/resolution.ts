/** Lowers the resolution where frames take too long, and raises it again where there is room. */

const SLOW = 50;
const FAST = 22;
const LEAST = 0.1;
/** Frames that must agree before the scale moves up. */
const PATIENCE = 12;
/** First frames of a picture, which the driver may spend on compiling. */
const WARM_UP = 2;
/** A smaller picture must be faster by this much, or pixels are not what takes the time. */
const GAIN = 0.85;

export class Resolution {
  private easy = 0;
  private cold = WARM_UP;
  /** A scale that turned out too slow is not tried again until the picture changes. */
  private ceiling = 1;
  private floor = LEAST;
  private before: { scale: number; milliseconds: number } | null = null;

  constructor(private value = 1) {}

  get scale(): number {
    return this.value;
  }

  /** Whether the next frame's time would tell nothing yet. */
  get warmingUp(): boolean {
    return this.cold > 0;
  }

  /** Takes one frame's time; says whether the scale moved. */
  frame(milliseconds: number): boolean {
    if (this.cold > 0) {
      this.cold -= 1;
      return false;
    }
    if (milliseconds > SLOW && this.value > this.floor) return this.lower(milliseconds);
    this.before = null;
    this.easy = milliseconds < FAST ? this.easy + 1 : 0;
    if (this.easy < PATIENCE || this.value >= this.ceiling) return false;
    this.move(Math.min(this.ceiling, this.value * 1.2));
    return true;
  }

  /** The picture became another one: what was too slow may be fast now. `most`: the scale to begin with, at the most. */
  reconsider(most: number): void {
    this.ceiling = 1;
    this.floor = LEAST;
    this.before = null;
    this.cold = WARM_UP;
    this.value = Math.max(LEAST, Math.min(this.value, most));
  }

  private lower(milliseconds: number): boolean {
    const { before } = this;
    if (before && milliseconds > GAIN * before.milliseconds) {
      // Nothing was gained: give the sharpness back.
      this.floor = before.scale;
      this.before = null;
      this.move(before.scale);
      return true;
    }
    this.before = { scale: this.value, milliseconds };
    this.ceiling = this.value * 0.95;
    this.move(Math.max(this.floor, this.value * Math.max(0.5, Math.sqrt((0.8 * SLOW) / milliseconds))));
    return true;
  }

  private move(scale: number): void {
    this.value = scale;
    this.easy = 0;
    // The first frame of a new size pays for new targets.
    this.cold = 1;
  }
}
