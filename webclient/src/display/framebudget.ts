/** What frames of a scale cost, and which scale keeps the time that they may take. */

export const MIN_SCALE = 0.05;
/** A picture of at least this scale is kept at the display's rate, with this share of its interval to spare. */
export const SMOOTH = { scale: 0.6, share: 0.85, shortest: 1000 / 120 };
/** Measured windows that the model is fitted to, and the weight of each against the one after it. */
export const FITTED = { samples: 5, weight: 0.5 };

/** Accepted frame time by scale, ms: linear between the points, constant beyond; it does not grow. */
export type FrameBudget = readonly (readonly [scale: number, milliseconds: number])[];

/** Where the display's rate is out of reach: down to 8 frames a second before the picture becomes too coarse. */
export const MOTION_BUDGET: FrameBudget = [[0.44, 125], [0.46, 64], [0.5, 58], [0.6, 46], [0.7, 36], [1, 34]];

/** What a frame costs: ms at any scale, and further ms at scale 1, which shrink with the pixels. */
export interface FrameCost { fixed: number; pixels: number; }

/** Measured load of this machine, with the current tier. */
export interface RenderLoad {
  cost: FrameCost | null; // Null before it is measured
  budget: FrameBudget;
  scale: number;
  displayInterval: number; // Time between two pictures of the display, ms
  megapixels: number; // At scale 1
}

/** Mean cost of a frame, ms, at a share x of the pixels. */
export interface Sample { x: number; cost: number; windows: number; }

export const costAt = ({ fixed, pixels }: FrameCost, scale: number): number => fixed + pixels * scale ** 2;

export function budgetAt(budget: FrameBudget, scale: number): number {
  const index = budget.findIndex(([point]) => point >= scale);
  const [above, below] = [budget.at(index), budget[index - 1]];
  if (index <= 0 || above === undefined || below === undefined) return above?.[1] ?? Infinity;
  return below[1] + ((above[1] - below[1]) * (scale - below[0])) / (above[0] - below[0]);
}

/** Greatest scale up to 1 that fits; it is assumed that all smaller ones do. */
function greatest(fits: (scale: number) => boolean): number {
  if (fits(1)) return 1;
  let [low, high] = [MIN_SCALE, 1];
  for (let i = 0; i < 20; i++) {
    const middle = 0.5 * (low + high);
    if (fits(middle)) low = middle;
    else high = middle;
  }
  return low;
}

const smoothTime = (displayInterval: number) => SMOOTH.share * Math.max(displayInterval, SMOOTH.shortest);

/** The scale to draw at: the greatest at the display's rate, unless that is too coarse; then the greatest within the budget. */
export function bestScale(cost: FrameCost, displayInterval: number, budget: FrameBudget = MOTION_BUDGET): number {
  const smooth = greatest((scale) => costAt(cost, scale) <= smoothTime(displayInterval));
  return smooth >= SMOOTH.scale ? smooth : greatest((scale) => costAt(cost, scale) <= budgetAt(budget, scale));
}

/** Greatest time that a frame of this scale may take, ms. */
export function allowedAt(scale: number, displayInterval: number, budget: FrameBudget = MOTION_BUDGET): number {
  return Math.max(smoothTime(displayInterval), budgetAt(budget, scale));
}

/** Least squares of the growth with the pixels, through the newest; null where costs do not grow with them. */
export function fitted(samples: readonly Sample[]): FrameCost | null {
  const newest = samples.at(-1);
  if (newest === undefined) return null;
  let [products, squares] = [0, 0];
  samples.forEach(({ x, cost }, i) => {
    const weight = FITTED.weight ** (samples.length - 1 - i);
    products += weight * (x - newest.x) * (cost - newest.cost);
    squares += weight * (x - newest.x) ** 2;
  });
  const pixels = Math.min(newest.cost / newest.x, products / squares);
  return pixels > 0 ? { fixed: newest.cost - pixels * newest.x, pixels } : null;
}
