/** Dynamic resolution: lowers the render scale while frames exceed their time budget, raises it while they keep it. */

export const MIN_SCALE = 0.1;
/** Frames after a change that are not measured: drivers compile and allocate in them. */
const WARM_UP = 2;
/** Frames averaged for one decision, and the time after which `minFrames` are enough, ms. */
const WINDOW = { frames: 10, minFrames: 3, milliseconds: 600 };
/** Limits of one change of the scale; a change within the dead band is not worth new targets. */
const STEP = { down: 0.6, up: 1.3 };
const DEAD_BAND = { down: 0.95, up: 1.06 };
/** Least ratio of render time to overhead: below it, a lower scale gains no speed. */
const RENDER_SHARE = 0.5;

/** Frame time budget by scale, ms: linear between the points, constant beyond. */
export type FrameBudget = readonly (readonly [scale: number, milliseconds: number])[];

/** On a CPU: 30 fps at moderate scales, fewer at low ones, so that the picture does not become too coarse. */
export const CPU_BUDGET: FrameBudget = [
  [0.1, 140],
  [0.3, 95],
  [0.5, 60],
  [0.6, 38],
  [0.7, 34],
  [1, 34],
];

/** On a GPU: the display's interval with a margin. */
export const gpuBudget = (displayInterval: number): FrameBudget => [[1, 0.85 * displayInterval]];

export function budgetAt(budget: FrameBudget, scale: number): number {
  let [previousScale, previous] = budget[0] ?? [0, Infinity];
  for (const [pointScale, milliseconds] of budget) {
    if (pointScale >= scale) {
      if (pointScale === previousScale) return milliseconds;
      return previous + ((milliseconds - previous) * (scale - previousScale)) / (pointScale - previousScale);
    }
    [previousScale, previous] = [pointScale, milliseconds];
  }
  return previous;
}

/** Greatest scale within the budget, if render time grows with the pixels and the rest of the interval is constant; times in ms. */
export function bestScale(budget: FrameBudget, scale: number, renderTime: number, interval: number): number {
  const overhead = Math.max(0, interval - renderTime);
  const lowest = Math.max(MIN_SCALE, Math.min(1, scale * Math.sqrt((RENDER_SHARE * overhead) / renderTime)));
  const fits = (candidate: number) => overhead + renderTime * (candidate / scale) ** 2 <= budgetAt(budget, candidate);
  if (fits(1)) return 1;
  let [low, high] = [lowest, 1];
  for (let i = 0; i < 20; i++) {
    const middle = 0.5 * (low + high);
    if (fits(middle)) low = middle;
    else high = middle;
  }
  return low;
}

export class DynamicResolution {
  private warmUpLeft = WARM_UP;
  private renderTime = 0;
  private interval = 0;
  private frames = 0;
  /** Windows since the scale last changed. */
  stableWindows = 0;
  /** Windows since the last reset. */
  windows = 0;
  /** Time between frames that was not render time, in the latest window, ms. */
  overhead = 0;

  constructor(private value = 1) {}

  get scale(): number {
    return this.value;
  }

  /** Adds a frame's render time and the interval since the frame before it, ms; returns whether the scale changed. */
  addFrame(budget: FrameBudget, renderTime: number, interval: number): boolean {
    if (this.warmUpLeft > 0) {
      this.warmUpLeft -= 1;
      return false;
    }
    this.renderTime += renderTime;
    this.interval += interval;
    this.frames += 1;
    const full = this.frames >= WINDOW.frames || (this.frames >= WINDOW.minFrames && this.interval >= WINDOW.milliseconds);
    if (!full) return false;
    const best = bestScale(budget, this.value, this.renderTime / this.frames, this.interval / this.frames);
    this.overhead = Math.max(0, (this.interval - this.renderTime) / this.frames);
    this.stableWindows += 1;
    this.windows += 1;
    this.restartWindow();
    const step = Math.min(STEP.up, Math.max(STEP.down, best / this.value));
    if (step > DEAD_BAND.down && step < DEAD_BAND.up && best < 1) return false;
    const scale = Math.min(1, this.value * step);
    if (scale === this.value) return false;
    this.value = scale;
    this.warmUpLeft = WARM_UP;
    this.stableWindows = 0;
    return true;
  }

  /** Discards the current window, as after a pause. */
  restartWindow(): void {
    this.renderTime = this.interval = this.frames = 0;
  }

  /** Starts again at a scale, for another plan. */
  reset(scale: number): void {
    this.value = Math.max(MIN_SCALE, Math.min(1, scale));
    this.warmUpLeft = WARM_UP;
    this.stableWindows = this.windows = 0;
    this.restartWindow();
  }
}
