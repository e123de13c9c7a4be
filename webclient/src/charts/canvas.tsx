/** A canvas that is painted whenever its painter changes. */
import { useLayoutEffect, useRef } from "preact/hooks";

interface CanvasProps {
  label: string;
  class?: string;
  /** Called again when it is another function. */
  paint: (canvas: HTMLCanvasElement) => void;
}

export function Canvas({ label, class: name, paint }: CanvasProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useLayoutEffect(() => {
    if (canvas.current !== null) paint(canvas.current);
  }, [paint]);
  return <canvas ref={canvas} class={name ?? ""} role="img" aria-label={label} />;
}
