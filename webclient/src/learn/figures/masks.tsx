/** Figure 4: what a mask's spectrum says of its bubbles. */
import { signal } from "@preact/signals";
import { render } from "preact";
import { Comparison } from "../drawing/compare";
import { loadMask, WHITE } from "../maths/mask";
import { Select, Slider } from "../parts/controls";
import type { FigureContext, LiveFigure } from "../parts/live";
import { followMask, maskOptions } from "../parts/masks";

export async function make({ api, plate, controls, redraw }: FigureContext): Promise<LiveFigure> {
  const [blue, white, options] = await Promise.all([loadMask(api, "vac-1.5"), loadMask(api, WHITE), maskOptions(api)]);
  const names = [signal("vac-1.5"), signal<string>(WHITE)] as const;
  const masks = [signal(blue), signal(white)] as const;
  const grey = signal(0.25);
  const comparison = new Comparison(plate);
  let stale = true;
  for (const shown of [...masks, grey]) {
    shown.subscribe(() => {
      stale = true;
      redraw();
    });
  }
  followMask(api, names[0], masks[0]);
  followMask(api, names[1], masks[1]);
  render(
    <>
      <Slider label="Saturation" value={grey} min={0.03} max={0.9} step={0.01} />
      <Select label="First mask" value={names[0]} options={options} />
      <Select label="Second mask" value={names[1]} options={options} />
    </>,
    controls,
  );
  return {
    resize: (width) => comparison.resize(width),
    draw: () => {
      // It does not move by itself.
      if (stale) comparison.show(masks[0].value, masks[1].value, grey.value);
      stale = false;
    },
  };
}
