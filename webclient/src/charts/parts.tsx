/** Canvases and tables of Preact views. */
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";

/** Gives a canvas a size, and each of its pixels, row by row, a colour of bytes. */
export function paintPixels(canvas: HTMLCanvasElement, width: number, height: number, colour: (pixel: number) => readonly [number, number, number]): void {
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d");
  if (context === null) return;
  const image = context.createImageData(width, height);
  for (let pixel = 0; pixel < width * height; pixel++) {
    const [r, g, b] = colour(pixel);
    image.data.set([r, g, b, 255], 4 * pixel);
  }
  context.putImageData(image, 0, 0);
}

interface CanvasProps {
  label: string;
  class?: string;
  /** Called again when one of the values differs that it shows. */
  paint: (canvas: HTMLCanvasElement) => void;
  shows: readonly unknown[];
}

/** A canvas that is painted whenever what it shows changes. */
export function Canvas({ label, class: name, paint, shows }: CanvasProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useLayoutEffect(() => {
    if (canvas.current !== null) paint(canvas.current);
  }, shows);
  return <canvas ref={canvas} class={name ?? ""} role="img" aria-label={label} />;
}

const TABLE =
  "w-full text-note [&_:is(th,td)]:py-0.5 [&_:is(th,td)]:pl-2 [&_:is(th,td)]:text-right [&_:is(th,td)]:font-normal [&_th:first-child]:pl-0 [&_th:first-child]:text-left " +
  "[&_thead_th]:text-fine [&_thead_th]:text-dim [&_tbody_tr]:border-t [&_tbody_tr]:border-hover [&_tbody_tr]:text-soft [&_tbody_tr]:hover:bg-hover [&_tr[aria-current]]:text-accent";

interface TableProps {
  heads: readonly string[];
  class?: string;
  look?: string; // Classes of rows and cells
  label?: string;
  children: ComponentChildren;
}

export function Table({ heads, class: more = "", look = TABLE, label, children }: TableProps) {
  return (
    <table class={`${more} ${look}`} aria-label={label}>
      <thead><tr>{heads.map((head, i) => <th scope="col" key={i}>{head}</th>)}</tr></thead>
      <tbody>{children}</tbody>
    </table>
  );
}
