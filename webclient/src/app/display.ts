/** What shows the picture: a viewport that draws it here, or frames that the server draws. */
import type { CameraState } from "../camera/state";
import type { RenderLoad } from "./autoquality";
import type { PlanLoader } from "./planloader";
import type { Viewport } from "./viewport";

/** Greatest pixels per CSS pixel: more cost time and are not visible. */
const MAX_PIXEL_RATIO = 2;

export const pixelRatio = (): number => Math.min(window.devicePixelRatio, MAX_PIXEL_RATIO);

export interface ViewState {
  time: number;
  camera: CameraState;
  /** Where the right picture begins, as a share of the width; 1 if there is only one. */
  divider: number;
}

export interface FrameTiming {
  /** ms; null until measured. */
  frame: number | null;
  /** What measured it: timer queries, a fence, or the time from request to decoded picture. */
  clock: "gpu" | "fence" | "server";
  fps: number;
  width: number;
  height: number;
  scale: number;
  /** Frames since the page opened. */
  frames: number;
}

export interface DisplayEvents {
  contextLost(): void;
  contextRestored(): void;
  failed(error: unknown): void;
  /** A frame is shown. */
  frameDone(): void;
}

export interface Display {
  /** Takes the pointer and the keys. */
  readonly canvas: HTMLCanvasElement;
  /** The viewport, if this browser draws; null if the server does. */
  readonly viewport: Viewport | null;
  /** Whether the picture is out of date. */
  dirty: boolean;
  /** Whether there is no picture yet. */
  readonly blank: boolean;
  /** Whether the picture is up to date at its final scale. */
  readonly atRest: boolean;
  /** The scale set by the user; null: dynamic. */
  readonly fixed: number | null;
  setFixedScale(scale: number | null): void;
  /** Called on every animation frame. `moving`: more frames will follow. */
  tick(now: number, view: ViewState, moving: boolean): void;
  timing(): FrameTiming;
  /** The load in motion; null if the page is not to adapt the quality to it. */
  load(): RenderLoad | null;
  /** Starts measuring again, as for a new plan. `expectedScale`: the scale to begin with. */
  resetMeasurement(expectedScale?: number | null): void;
}

export type MakeDisplay = (loaders: readonly [PlanLoader, PlanLoader], events: DisplayEvents) => Display;
