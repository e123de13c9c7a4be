/** Pixels of an element on its screen. */

/** Greatest pixels per CSS pixel: more cost time and are not visible. */
const MAX_PIXEL_RATIO = 2;

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
