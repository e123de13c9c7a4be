/** Figure 4: what a mask's spectrum says of its bubbles. */
import { effect, signal } from "@preact/signals";
import { Comparison } from "../drawing/compare";
import { followedMask, maskOptions, WHITE } from "../maths/mask";
import { type FigureContext, type LiveFigure, Select, Slider } from "../parts/live";

export async function make({ api, plate }: FigureContext): Promise<LiveFigure> {
  const names = [signal("vac-1.5"), signal<string>(WHITE)] as const;
  const [first, second, options] = await Promise.all([followedMask(api, names[0]), followedMask(api, names[1]), maskOptions(api)]);
  const grey = signal(0.25);
  const comparison = new Comparison(plate);
  effect(() => comparison.show(first.value, second.value, grey.value));
  return {
    controls: (
      <>
        <Slider label="Saturation" value={grey} min={0.03} max={0.9} step={0.01} />
        <Select label="First mask" value={names[0]} options={options} />
        <Select label="Second mask" value={names[1]} options={options} />
      </>
    ),
    resize: (width) => comparison.resize(width),
  };
}
