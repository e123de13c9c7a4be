/** What a surface knows of the page and can do to it. */
import type { Api } from "../api";
import type { CameraState } from "../camera/state";
import type { Viewport } from "../display/viewport";
import type { FramePlan } from "../generated/api";
import type { Executor } from "../plan/executor";
import type { Selection } from "../selection/selection";
import type { Recipe } from "../take/recipe";

export interface SurfaceContext {
  api: Api;
  /** This browser's canvas; null while the server draws. */
  viewport: () => Viewport | null;
  selection: () => Selection;
  /** Plan of the picture, or of its left part; null until loaded. */
  plan: () => FramePlan | null;
  /** What draws the plan; null until loaded, and where the server draws. */
  executor: () => Executor | null;
  time: () => number;
  camera: () => CameraState;
  playing: () => boolean;
  /** The current view, at the size of the canvas. */
  recipe: () => Recipe;
  /** The picture as PNG, with its recipe. */
  png: () => Promise<Blob>;
  /** Saves a file under the name of the preset and the time. */
  save: (blob: Promise<Blob>, suffix: string) => Promise<void>;
  copyLink: () => Promise<void>;
  /** Restores the view that a picture's recipe describes. */
  restore: (file: Blob) => Promise<void>;
  failed: (error: unknown) => void;
  /** Calls back when selection, plan, time or camera change, not in every frame of motion; returns what ends that. */
  onChange: (listener: () => void) => () => void;
  close: () => void;
}

/** Shows a surface in an element; returns what removes it. */
export type Mount = (root: HTMLElement, context: SurfaceContext) => () => void;
