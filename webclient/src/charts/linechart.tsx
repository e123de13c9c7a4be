/** Charts by uPlot with this page's look; lines over logarithmic axes, or a linear one upwards, with a legend and the values as a table. */
import "uplot/dist/uPlot.min.css";
import type { RefObject } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import uPlot from "uplot";
import { type Axis, linearAxis, logAxis, tickLabels } from "./axis";
import { Table } from "./parts";

export const INK = { text: "rgb(210 226 234 / 72%)", grid: "rgb(190 220 235 / 9%)", accent: "#f3c795", teal: "#7fc4c0", pale: "rgb(210 226 234 / 50%)" };
const MARGIN = { left: 54, right: 14, top: 12, bottom: 40 }; // Space around the plotted area, px
const FONT = "11px ui-sans-serif, system-ui, sans-serif";
const SPACING = { x: 34, y: 17 }; // Least distance of tick labels, px

const LOGARITHMIC = 3 as unknown as uPlot.Scale.Distr; // The package's enumeration exists in its types only

export interface Axes { x: Axis; y: Axis; xLabel: string; yLabel: string; }

type PlotSize = { width: number; height: number };

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

/** Options for a plot with two axes. */
export function plotOptions({ width, height }: PlotSize, axes: Axes, series: uPlot.Series[], draw?: (u: uPlot) => void): uPlot.Options {
  const labels = {
    x: tickLabels(axes.x, width - MARGIN.left - MARGIN.right, SPACING.x),
    y: tickLabels(axes.y, height - MARGIN.top - MARGIN.bottom, SPACING.y),
  };
  const axis = (name: "x" | "y", label: string): uPlot.Axis => ({
    ...{ scale: name, label, font: FONT, labelFont: FONT, stroke: INK.text, gap: 5 },
    ...(name === "x" ? { size: 22, labelSize: MARGIN.bottom - 22 } : { size: 36, labelSize: MARGIN.left - 36 }),
    ...{ grid: { stroke: INK.grid, width: 1 }, ticks: { show: false } },
    splits: () => axes[name].ticks,
    filter: (_, splits) => splits,
    values: () => labels[name],
  });
  const scale = ({ logarithmic, low, high }: Axis): uPlot.Scale => ({ time: false, range: () => [low, high], ...(logarithmic ? { distr: LOGARITHMIC } : {}) });
  return {
    ...{ width, height, series, legend: { show: false }, cursor: { show: false }, select: { show: false, left: 0, top: 0, width: 0, height: 0 } },
    padding: [MARGIN.top, MARGIN.right, 0, 0],
    scales: { x: scale(axes.x), y: scale(axes.y) },
    axes: [axis("x", axes.xLabel), axis("y", axes.yLabel)],
    ...(draw ? { hooks: { draw: [draw] } } : {}),
  };
}

/** Place of a value in the element, px from its left and top. */
export function place({ width, height }: PlotSize, axes: Axes, x: number, y: number): { x: number; y: number } {
  return {
    x: MARGIN.left + (width - MARGIN.left - MARGIN.right) * axes.x.position(x),
    y: height - MARGIN.bottom - (height - MARGIN.top - MARGIN.bottom) * axes.y.position(y),
  };
}

export interface Line {
  label: string;
  colour: string;
  dashed?: boolean;
  values: readonly (number | null)[]; // At the chart's places; null and what is not positive is a gap
}

interface LineChartProps {
  title: string;
  x: readonly number[];
  lines: readonly Line[];
  xLabel: string;
  yLabel: string;
  linear?: boolean; // Whether the axis upwards is linear
}

const positive = (value: number | null) => (value !== null && value > 0 ? value : null);

export function LineChart({ title, x, lines, xLabel, yLabel, linear = false }: LineChartProps) {
  const host = useRef<HTMLDivElement>(null);
  const size = useSize(host);
  useLayoutEffect(() => {
    const node = host.current;
    if (node === null || size.width === 0) return;
    const shown = lines.flatMap(({ values }) => values.filter((value) => value !== null));
    const axes = { x: logAxis(x), y: linear ? linearAxis(shown) : logAxis(shown), xLabel, yLabel };
    const drawn = lines.map(({ values }) => (linear ? [...values] : values.map(positive)));
    const series = lines.map(({ label, colour, dashed }) => ({
      ...{ label, stroke: colour, width: 1.5, points: { show: false } },
      ...(dashed ? { dash: [4, 4] } : {}),
    }));
    const plot = new uPlot(plotOptions(size, axes, [{}, ...series]), [[...x], ...drawn], node);
    return () => plot.destroy();
  }, [size, x, lines, xLabel, yLabel, linear]);
  return (
    <div class="line-chart">
      <div class="h-(--chart-height,190px)" role="img" aria-label={title} ref={host} />
      <ul class="legend mt-0.5 flex flex-wrap gap-x-4 gap-y-1 text-small text-soft">
        {lines.map(({ label, colour, dashed }, i) => (
          <li key={i} class={`before:mr-[7px] before:mb-[3px] before:inline-block before:w-4 before:border-t-2 before:border-(--colour) ${dashed ? "before:border-dashed" : ""}`} style={{ "--colour": colour }}>
            {label}
          </li>
        ))}
      </ul>
      <details class="disclosure mt-1.5">
        <summary>Values</summary>
        <div class="max-h-60 overflow-auto">
          <Table heads={[xLabel, ...lines.map(({ label }) => label)]}>
            {x.map((at, i) => (
              <tr key={at}>
                <th scope="row">{at.toPrecision(3)}</th>
                {lines.map(({ values }, column) => <td key={column}>{values[i]?.toPrecision(3) ?? "–"}</td>)}
              </tr>
            ))}
          </Table>
        </div>
      </details>
    </div>
  );
}
