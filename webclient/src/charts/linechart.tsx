/** Lines over logarithmic axes, or a linear one upwards, with a legend and the values as a table. */
import { useLayoutEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { linearAxis, logAxis } from "./axis";
import { Table } from "./table";
import { plotOptions, useSize } from "./uplot";

export interface Line {
  label: string;
  colour: string;
  dashed?: boolean;
  /** At the chart's places; null and what is not positive is a gap. */
  values: readonly (number | null)[];
}

interface LineChartProps {
  title: string;
  x: readonly number[];
  lines: readonly Line[];
  xLabel: string;
  yLabel: string;
  /** Whether the axis upwards is linear. */
  linear?: boolean;
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
