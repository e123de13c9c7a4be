/** Simulated machines, and the page's loop on them: what the controller of the resolution is held to. */
import type { DynamicResolution } from "../../src/display/resolution";

export interface Machine {
  /** Cost of a frame, ms: at any scale, and further at scale 1. */
  fixed: number;
  pixels: number;
  /** Interval of the display, ms. */
  display: number;
  /** Step of the page's clock, ms. */
  clock: number;
  /** The page's thread waits for each frame, and notices all fences at once. */
  blocked: boolean;
  /** Random share by which costs differ from frame to frame. */
  jitter: number;
}

export interface Disturbance {
  /** s */
  begin: number;
  end: number;
  /** Multiple of the cost meanwhile. */
  load: number;
}

export interface Shown {
  /** When it was finished, and the interval since the frame before, ms. */
  at: number;
  interval: number;
  scale: number;
}

/** Times of a loop that the page tells the controller apart from frames. */
export interface Events {
  disturbances?: readonly Disturbance[];
  /** A single frame that takes longer, ms. */
  hiccup?: { at: number; milliseconds: number };
  /** No animation frames meanwhile, s; `told`: the page knows of it. */
  hidden?: { begin: number; end: number; told: boolean };
  /** Another plan: its first frame compiles, ms; its costs are multiplied. */
  plan?: { at: number; compiles: number; load: number; told: number };
}

/** Small and repeatable; in [0, 1). */
function random(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

const POLL = 4;

/** Runs the page's loop for so many seconds; returns the frames that were shown. */
export function run(controller: DynamicResolution, machine: Machine, seconds: number, events: Events = {}, seed = 1): Shown[] {
  const { display, clock } = machine;
  const dice = random(seed);
  const read = (t: number) => Math.floor(t / clock) * clock;
  const shown: Shown[] = [];
  const pending: { scale: number; submitted: number; done: number }[] = [];
  let [idle, free, lastDone, hiccup, planned, hidden] = [0, 0, 0, false, false, false];
  const notice = (t: number) => {
    for (let frame = pending[0]; frame !== undefined && frame.done <= t; frame = pending[0]) {
      pending.shift();
      shown.push({ at: frame.done, interval: frame.done - lastDone, scale: frame.scale });
      lastDone = frame.done;
      const noticed = machine.blocked ? t : Math.min(t, Math.ceil(frame.done / POLL) * POLL);
      controller.addFrame({ scale: frame.scale, submitted: frame.submitted, done: read(noticed) });
    }
  };
  controller.displayInterval = display;
  for (let tick = 0; tick < 1000 * seconds; tick += display) {
    if (events.hidden && tick >= 1000 * events.hidden.begin && !hidden) {
      hidden = true;
      if (events.hidden.told) controller.pause();
      tick = Math.ceil((1000 * events.hidden.end) / display) * display;
      lastDone = tick;
    }
    if (tick < idle) continue;
    notice(tick);
    if (events.plan && !planned && tick >= 1000 * events.plan.at) {
      planned = true;
      controller.expect(events.plan.told);
      free = Math.max(free, tick) + events.plan.compiles;
    }
    if (pending.length >= controller.depth) continue;
    const { scale } = controller;
    let cost = (machine.fixed + machine.pixels * scale ** 2) * (1 + machine.jitter * (dice() - 0.5));
    for (const { begin, end, load } of events.disturbances ?? []) if (tick >= 1000 * begin && tick < 1000 * end) cost *= load;
    if (planned) cost *= events.plan?.load ?? 1;
    if (events.hiccup && !hiccup && tick >= 1000 * events.hiccup.at) {
      hiccup = true;
      cost += events.hiccup.milliseconds;
    }
    free = Math.max(free, tick) + cost;
    pending.push({ scale, submitted: read(tick), done: free });
    if (machine.blocked) idle = free;
  }
  return shown;
}
