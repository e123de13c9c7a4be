/** Chooses how sharp a moving picture is: the scale whose frames come as often as that scale deserves. */

export const LEAST = 0.1;
/** Frames of a picture or a size that a driver may spend on compiling and on new targets. */
const WARM_UP = 2;
/** Frames that are judged together, and the time after which fewer will do, ms. */
const SPAN = { frames: 10, least: 3, milliseconds: 600 };
/** A step of the scale is at most so large, and at least this far from 1, or it is not worth new targets. */
const STEP = { down: 0.6, up: 1.3 };
const DEAD = { down: 0.95, up: 1.06 };
/** Of what the rest of the page takes, the share that the water gets in any case: with less, a coarser picture gains nothing. */
const WATER = 0.5;

/** By scale, the time from one frame to the next that is put up with, ms. */
export type Law = readonly (readonly [scale: number, milliseconds: number])[];

/** A CPU draws: thirty frames a second while the picture is fairly sharp; a coarse one gives motion up before more sharpness. */
export const ON_CPU: Law = [
  [0.1, 140],
  [0.3, 95],
  [0.5, 60],
  [0.6, 38],
  [0.7, 34],
  [1, 34],
];

/** A GPU draws, beside the rest of the page and not after it: within the display's interval, and not to the last of it. */
export const onGpu = (display: number): Law => [[1, 0.85 * display]];

/** What the law puts up with at a scale, ms. */
export function allowed(law: Law, scale: number): number {
  let [below, slowest] = law[0] ?? [0, Infinity];
  for (const [at, milliseconds] of law) {
    if (at >= scale) return at === below ? milliseconds : slowest + ((milliseconds - slowest) * (scale - below)) / (at - below);
    [below, slowest] = [at, milliseconds];
  }
  return slowest;
}

/**
 * The greatest scale that keeps the law, if the water took `water` of `interval` ms from frame to frame at scale `now`, grows with
 * its pixels, and the rest stays what it is.
 */
export function bestScale(law: Law, now: number, water: number, interval: number): number {
  const rest = Math.max(0, interval - water);
  const floor = Math.max(LEAST, Math.min(1, now * Math.sqrt((WATER * rest) / water)));
  const keeps = (scale: number) => rest + water * (scale / now) ** 2 <= allowed(law, scale);
  if (keeps(1)) return 1;
  let [low, high] = [floor, 1];
  for (let i = 0; i < 20; i++) {
    const middle = 0.5 * (low + high);
    if (keeps(middle)) low = middle;
    else high = middle;
  }
  return low;
}

export class Pace {
  private cold = WARM_UP;
  private water = 0;
  private interval = 0;
  private frames = 0;
  /** Spans since the scale moved last, and since the picture became another one. */
  steady = 0;
  spans = 0;
  /** ms from frame to frame that were not the water's, in the latest span. */
  rest = 0;

  constructor(private value = 1) {}

  get scale(): number {
    return this.value;
  }

  /** Whether the next frame's time would tell nothing yet. */
  get warmingUp(): boolean {
    return this.cold > 0;
  }

  /** Takes what a frame's water took and how long after the frame before it came, ms; says whether the scale moved. */
  frame(law: Law, water: number, interval: number): boolean {
    if (this.cold > 0) {
      this.cold -= 1;
      return false;
    }
    this.water += water;
    this.interval += interval;
    this.frames += 1;
    const enough = this.frames >= SPAN.frames || (this.frames >= SPAN.least && this.interval >= SPAN.milliseconds);
    if (!enough) return false;
    const best = bestScale(law, this.value, this.water / this.frames, this.interval / this.frames);
    this.rest = Math.max(0, (this.interval - this.water) / this.frames);
    this.steady += 1;
    this.spans += 1;
    this.begin();
    const step = Math.min(STEP.up, Math.max(STEP.down, best / this.value));
    // Each span is judged by itself: whatever slowed an earlier one may be over.
    if (step > DEAD.down && step < DEAD.up && best < 1) return false;
    const scale = Math.min(1, this.value * step);
    if (scale === this.value) return false;
    this.value = scale;
    this.cold = WARM_UP;
    this.steady = 0;
    return true;
  }

  /** Motion paused: the frames until then are no span. */
  begin(): void {
    this.water = this.interval = this.frames = 0;
  }

  /** The picture became another one: what was too slow may be fast now. `most`: the scale to begin with, at the most. */
  reconsider(most: number): void {
    this.value = Math.max(LEAST, Math.min(1, most));
    this.cold = WARM_UP;
    this.steady = this.spans = 0;
    this.begin();
  }
}
