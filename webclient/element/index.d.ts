/** Water of a Seafoam server; defined as `<seafoam-water>` when the module is loaded. */
export declare class SeafoamWater extends HTMLElement {
  /** Time of the picture, s. */
  readonly currentTime: number;
  /** Frames that were drawn; 0 while a still of the server is shown. */
  readonly frames: number;
}

declare global {
  interface HTMLElementTagNameMap {
    "seafoam-water": SeafoamWater;
  }
}
