/** An element's size as state. */
import type { RefObject } from "preact";
import { useLayoutEffect, useState } from "preact/hooks";
import type { PlotSize } from "./uplot";

/** Follows the size of an element, px; 0 before it is laid out. */
export function useSize(ref: RefObject<HTMLElement>): PlotSize {
  const [size, setSize] = useState<PlotSize>({ width: 0, height: 0 });
  useLayoutEffect(() => {
    const node = ref.current;
    if (node === null) return;
    const update = () => {
      const { clientWidth: width, clientHeight: height } = node;
      setSize((before) => (before.width === width && before.height === height ? before : { width, height }));
    };
    const observer = new ResizeObserver(update);
    observer.observe(node);
    update();
    return () => observer.disconnect();
  }, [ref]);
  return size;
}
