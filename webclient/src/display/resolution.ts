/** Dynamic resolution: the scale at which frames keep their budget, from nothing but the times of the frames before. */
import { allowedAt, bestScale, budgetAt, FITTED, fitted, type FrameBudget, type FrameCost, MIN_SCALE, MOTION_BUDGET, type Sample, SMOOTH } from "./framebudget";

const FIRST_PIXELS = 96 * 54; // Pixels of the first frame of a machine that nobody knows yet
const AT_RATE = 1.12; // Intervals up to this multiple of the display's are the display's rate
const NO_CEILING = { scale: Infinity, until: 0, pause: 0 };
/** Frames and time of one decision, which also takes so many steps of the clock: fewer at first. */
const WINDOW = { leastFrames: 3, leastTime: 80, frames: 12, steps: [3, 6] } as const;
/** A change within the dead band is not worth new targets; one step at most multiplies the scale so. */
const DEAD_BAND = { down: 0.94, up: 1.08 };
const STEP_UP = 2.5;
/** Time until a scale that was too much is tried again, ms; it doubles up to these, the second where the cost is not known. */
const PAUSE = { first: 500, usual: 2000, probe: 60_000 };
/** A single frame of this multiple of its budget is answered at once; right after a change of the scale, of the second. */
const EMERGENCY = { usual: 1.8, changed: 3 };
const COMPILING = 2; // First frames of a plan: drivers compile in them
const NEWEST = 0.5; // Share of the newest window in the mean of those at one scale; less by a coarse clock

/** ms, of any clock, however coarse. `done`: when it was noticed that the frame is finished. */
interface FrameTimes { scale: number; submitted: number; done: number; }

export class DynamicResolution {
  displayInterval = 1000 / 60; // Time between two pictures of the display, ms
  windows = 0; // Windows measured with this plan
  measured: number | null = null; // ms a frame, lately
  private value: number;
  private samples: Sample[] = [];
  private window = { frames: 0, busy: 0, began: 0 };
  private lastDone: number | null = null;
  private quantum = Infinity;
  /** Frames that are not measured: the first of a plan compile, the first of a scale makes new targets. */
  private compiling = COMPILING;
  private fresh = false;
  private probedFrom: number | null = null;
  private ceiling = { ...NO_CEILING }; // A scale that did not keep the display's rate, and when it may be tried again

  /** `pixels`: of the window, at scale 1; `first`: of the first frame; `least`: scale, whatever it takes. */
  constructor(pixels: number, private readonly budget: FrameBudget = MOTION_BUDGET, first = FIRST_PIXELS, private readonly least = MIN_SCALE) {
    this.value = Math.min(1, Math.max(least, Math.sqrt(first / Math.max(1, pixels))));
  }

  /** To draw the next frame at. */
  get scale(): number { return this.value; }

  /** Smallest step of the clock that was seen, ms. */
  private get step(): number { return this.quantum === Infinity ? 0 : this.quantum; }

  /** Frames that may be pending: two keep a GPU busy; where one takes longer than the display, a second only waits. */
  get depth(): number { return this.measured !== null && this.measured < this.displayInterval ? 2 : 1; }

  /** The fitted cost; null before the first window. */
  get cost(): FrameCost | null {
    for (let count = this.samples.length; count > 1; count--) {
      const fit = fitted(this.samples.slice(-count));
      if (fit !== null) return fit;
    }
    const last = this.samples.at(-1);
    return last ? { fixed: 0, pixels: last.cost / last.x } : null;
  }

  /** The next frames come after a pause, which is no frame's time. */
  pause(): void {
    this.lastDone = null;
    this.restartWindow();
  }

  /** Frames will cost a multiple of what they did: of another plan, which compiles, or in another window. */
  expect(factor: number, compiles = true): void {
    this.samples = this.samples.map((one) => ({ ...one, cost: one.cost * factor }));
    this.value = Math.min(1, Math.max(this.least, this.value / Math.sqrt(factor)));
    this.ceiling = { ...NO_CEILING };
    if (compiles) this.compiling = COMPILING;
    this.fresh = true;
    this.windows = 0;
    this.pause();
  }

  /** Adds a finished frame, in the order of submission; returns whether the scale changed. */
  addFrame({ scale, submitted, done }: FrameTimes): boolean {
    const { lastDone } = this;
    this.lastDone = done;
    if (lastDone !== null && done > lastDone) this.quantum = Math.min(this.quantum, done - lastDone);
    if (done > submitted) this.quantum = Math.min(this.quantum, done - submitted);
    if (scale !== this.value) return false;
    // A frame takes what its interval shows beyond the time in which nothing was submitted.
    const began = Math.max(submitted, lastDone ?? submitted);
    const { compiling, fresh } = this;
    this.fresh = false;
    if (compiling > 0 || fresh) {
      this.compiling = Math.max(0, compiling - 1);
      this.restartWindow(done);
      return compiling === 0 && this.answered(done - began, EMERGENCY.changed);
    }
    if (lastDone === null) this.restartWindow(submitted);
    if (this.answered(done - began, EMERGENCY.usual)) return true;
    this.window.frames += 1;
    this.window.busy += done - began;
    const elapsed = done - this.window.began;
    const { frames } = this.window;
    if (frames < WINDOW.leastFrames || elapsed < WINDOW.steps[this.windows < 4 ? 0 : 1] * this.step || (frames < WINDOW.frames && elapsed < WINDOW.leastTime)) return false;
    return this.decide(this.window.busy / frames, elapsed / frames, frames, done);
  }

  /** Shrinks for a single frame that took far too long for certain, whatever the clock's steps. */
  private answered(took: number, excess: number): boolean {
    const certain = took - this.step;
    if (certain <= excess * allowedAt(this.value, this.displayInterval, this.budget)) return false;
    return this.change(bestScale({ fixed: 0, pixels: certain / this.value ** 2 }, this.displayInterval, this.budget));
  }

  /** Decides on a window: ms a frame that the machine was busy, and from frame to frame. */
  private decide(busy: number, interval: number, frames: number, now: number): boolean {
    const { value, displayInterval, probedFrom } = this;
    this.windows += 1;
    this.measured = busy > 0 ? busy : interval;
    this.probedFrom = null;
    this.restartWindow(now);
    // A coarse clock may have read all of the window too long by a step.
    const atRate = interval - this.step / frames <= AT_RATE * displayInterval;
    const excess = interval > budgetAt(this.budget, value) || (probedFrom ?? 0) >= SMOOTH.scale;
    if (probedFrom !== null && !atRate && excess) return this.withdraw(probedFrom, now, PAUSE.probe);
    if (atRate && busy > SMOOTH.share * displayInterval) return this.probe(busy, now);
    this.learn(value ** 2, Math.max(busy, 0.01), this.step / frames);
    const cost = this.cost ?? { fixed: 0, pixels: busy };
    const best = bestScale(cost, displayInterval, this.budget);
    if (best < DEAD_BAND.down * value) return !atRate && this.withdraw(best, now, PAUSE.usual);
    const most = now < this.ceiling.until ? DEAD_BAND.down * this.ceiling.scale : 1;
    const to = Math.min(best, most, value * this.stepUp(busy));
    return (to > DEAD_BAND.up * value || (to === 1 && value < 1)) && this.change(to);
  }

  /** Greatest factor to grow by: where the fixed part is not known, all of the cost may be the pixels'. */
  private stepUp(busy: number): number {
    const safe = Math.sqrt((this.budget[0]?.[1] ?? Infinity) / Math.max(busy, 1));
    return (this.cost?.fixed ?? 0) > 0 ? STEP_UP : Math.max(1, Math.min(STEP_UP, safe));
  }

  /** At the display's rate, where the cost is known to be no more than its interval: tries more. */
  private probe(busy: number, now: number): boolean {
    const { value, ceiling } = this;
    const to = now < ceiling.until ? Math.sqrt(value * ceiling.scale) : value * this.stepUp(busy);
    if (to < DEAD_BAND.up * value) return false;
    this.probedFrom = value;
    return this.change(to);
  }

  /** Too much at this scale: back, and no farther for a while, longer each time that it happens again. */
  private withdraw(to: number, now: number, longest: number): boolean {
    const { until, pause } = this.ceiling;
    const again = now < until + 4 * pause ? Math.min(longest, 2 * pause) : PAUSE.first;
    this.ceiling = { scale: this.value, until: now + again, pause: again };
    return this.change(to);
  }

  private change(to: number): boolean {
    const scale = Math.min(1, Math.max(this.least, to));
    if (scale === this.value) return false;
    this.value = scale;
    this.fresh = true;
    return true;
  }

  /** `slack`: by how much a coarse clock may have read the cost wrongly, ms. */
  private learn(x: number, cost: number, slack: number): void {
    const last = this.samples.at(-1);
    const others = this.samples.filter((one) => one.x !== x).slice(1 - FITTED.samples);
    if (last?.x !== x) {
      this.samples = [...others, { x, cost, windows: 1 }];
      return;
    }
    // At the same scale another cost is another load, which the other scales have too.
    const changed = Math.abs(cost - last.cost) > 0.3 * last.cost + 2 * slack;
    const scaled = changed ? others.map((one) => ({ ...one, cost: (one.cost * cost) / last.cost })) : others;
    if (changed && cost < last.cost) this.ceiling = { ...NO_CEILING };
    const windows = changed ? 0 : last.windows;
    const share = Math.max(1 / (windows + 1), NEWEST / (1 + (4 * this.step) / cost));
    this.samples = [...scaled, { x, cost: last.cost + (windows === 0 ? 1 : share) * (cost - last.cost), windows: windows + 1 }];
  }

  private restartWindow(began = 0): void {
    this.window = { frames: 0, busy: 0, began };
  }
}
