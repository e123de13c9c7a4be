/** What shows the picture: a viewport that draws it here, or frames that the server draws; pixels of either. */
import type { CameraState } from "../camera/state";
import type { Gpu } from "../gl/gpu";
import type { RenderLoad } from "./framebudget";

const MAX_PIXEL_RATIO = 2; // Greatest pixels per CSS pixel: more cost time and are not visible

export const pixelRatio = (): number => Math.min(window.devicePixelRatio, MAX_PIXEL_RATIO);

/** Pixels of an element at scale 1. */
export const pixelsOf = ({ clientWidth, clientHeight }: HTMLElement): number => clientWidth * clientHeight * pixelRatio() ** 2;

/** Pixels along an element's sides, with so many for a CSS pixel. */
export function pixelSize({ clientWidth, clientHeight }: HTMLElement, ratio: number): [width: number, height: number] {
  return [Math.max(1, Math.round(clientWidth * ratio)), Math.max(1, Math.round(clientHeight * ratio))];
}

/** Gives a canvas a size. To set it clears the canvas, even to the same size. */
export function resizeCanvas(canvas: HTMLCanvasElement, width: number, height: number): void {
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
}

/** Calls back whenever an element's pixels change: its size, or the device's pixels per CSS pixel, as on another screen. */
export function onPixelsChange(observed: HTMLElement, changed: () => void): void {
  new ResizeObserver(changed).observe(observed);
  const watch = () => {
    const query = matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`);
    const moved = () => {
      changed();
      watch();
    };
    query.addEventListener("change", moved, { once: true });
  };
  watch();
}

/** Times of the frames shown in the last second. */
export class ShownFrames {
  total = 0; // Since the page opened
  private readonly recent: number[] = [];

  add(): void {
    this.total += 1;
    this.recent.push(performance.now());
  }

  get fps(): number {
    const now = performance.now();
    while (this.recent[0] !== undefined && now - this.recent[0] > 1000) this.recent.shift();
    return this.recent.length;
  }
}

/** `divider`: where the right picture begins, as a share of the width; 1 if there is only one. */
export interface ViewState { time: number; camera: CameraState; divider: number; }

/** Who draws: this browser, or the server, frame by frame. */
export type FrameSource = "browser" | "server";

/** Who draws, as the user wishes; auto: whoever gives more. */
export type FrameSourceChoice = FrameSource | "auto";

export interface FrameTiming {
  frame: number | null; // Of a frame, ms; null until measured
  fps: number; // Frames shown in the last second
  width: number;
  height: number;
  scale: number;
  frames: number; // Frames since the page opened
  tier: string | null; // The tier of the picture, if it is not the selection's
}

/** `cost`: of its frames, as a multiple of those of the tier before it. */
export interface MovingTier { tier: string; cost: number; }

/** What is drawn in motion. */
export interface Rate { scale: number; fps: number; }

export interface DisplayEvents {
  contextLost(): void;
  contextRestored(): void;
  failed(error: unknown): void;
  frameDone(): void; // A frame is shown
  sourceChanged(): void; // The other source draws from now on
  /** The tier in which the server is to draw frames in motion; null: as selected; undefined: it will be known soon. */
  movingTier(load: RenderLoad): MovingTier | null | undefined;
}

export interface Display {
  readonly canvas: HTMLCanvasElement; // Takes the pointer and the keys
  readonly gpu: Gpu | null; // What draws, if this browser does; null if the server does
  dirty: boolean; // Whether the picture is out of date
  readonly blank: boolean; // Whether there is no picture yet
  readonly presentable: boolean; // Whether the picture is good enough to take the place of the still
  readonly atRest: boolean; // Whether the picture is up to date at its final scale
  readonly fixed: number | null; // The scale set by the user; null: dynamic
  setFixedScale(scale: number | null): void;
  /** Called on every animation frame. `moving`: more frames will follow. */
  tick(now: number, view: ViewState, moving: boolean): void;
  timing(): FrameTiming;
  /** Measured in motion with the current plan; null until it is, or while the user has set the scale. */
  rate(): Rate | null;
  load(): RenderLoad | null; // The load in motion; null if the page is not to adapt the quality to it
  readonly stalled: string | null; // Why the picture does not move; null if it can
  planChanged(cost: number): void; // Another plan is drawn. `cost`: of its frames, as a multiple of the former plan's.
}
