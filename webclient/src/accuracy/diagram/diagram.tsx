/** A work-precision diagram: log error against log time, a curve for each quality setting, a mark for each quality. */
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import uPlot from "uplot";
import { type Axes, INK, place, plotOptions, useSize } from "../../charts/linechart";
import { formatNumber, type Ranked } from "../measure/measured";
import type { Session } from "../session";
import { type Curve, placeLabels } from "./curves";

const HIT_RADIUS = 26; // Greatest distance of the pointer from a mark, px

interface DiagramProps {
  kind: string; // Class of the figure
  title: string;
  caption: string;
  marks: readonly Ranked[]; // Fastest first
  curves: readonly Curve[];
  axes: Axes;
  session: Session;
  fitting: ReadonlySet<string> | null; // Ids within the budget; null: all
}

type PlacedMark = Ranked & { x: number; y: number };

/** Tiers are labelled in the diagram. */
const isTier = ({ point }: Ranked) => point.tier !== null;

/** Id of the quality that the page runs. */
const currentOf = (session: Session) => session.current.value?.point.id ?? null;

/** "1.2 ms, error 3.4". */
const describe = ({ time, error }: Ranked) => `${formatNumber(time)} ms, error ${formatNumber(error)}`;

export function Diagram(props: DiagramProps) {
  const { kind, title, caption, marks, axes, session } = props;
  const highlight = (id: string | null) => (session.highlighted.value = id);
  const host = useRef<HTMLDivElement>(null);
  const overlay = useRef<SVGSVGElement>(null);
  const size = useSize(host);
  const [tabStop, setTabStop] = useState<string | null>(null);
  useCurves(host, props, size);
  const placed = marks.map((mark) => ({ ...mark, ...place(size, axes, mark.time, mark.error) }));
  const nearest = ({ clientX, clientY }: MouseEvent) => {
    const box = host.current?.getBoundingClientRect();
    const distance = (mark: PlacedMark) => Math.hypot(mark.x - (clientX - (box?.left ?? 0)), mark.y - (clientY - (box?.top ?? 0)));
    return placed.filter((mark) => distance(mark) <= HIT_RADIUS).sort((a, b) => distance(a) - distance(b))[0];
  };
  const stop = placed.find(({ id }) => id === tabStop)?.id ?? currentOf(session) ?? placed[0]?.id ?? null;
  const onKey = (event: KeyboardEvent, index: number) => {
    const last = placed.length - 1;
    const target = { ArrowLeft: index - 1, ArrowDown: index - 1, ArrowRight: index + 1, ArrowUp: index + 1, Home: 0, End: last }[event.key];
    const isSelect = event.key === "Enter" || event.key === " ";
    if (target === undefined && !isSelect) return;
    event.preventDefault();
    const mark = placed[isSelect ? index : Math.min(last, Math.max(0, target ?? 0))];
    if (mark === undefined) return;
    if (isSelect) session.select(mark.id);
    setTabStop(mark.id);
    overlay.current?.querySelector<SVGElement>(`[data-id="${CSS.escape(mark.id)}"]`)?.focus();
  };
  const tip = placed.find(({ id }) => id === session.highlighted.value);
  return (
    <figure class={`chart ${kind} -mx-1.5 min-w-0 ${marks.length === 0 ? "opacity-40" : ""}`}>
      <figcaption class="truncate pl-[54px] text-fine">{caption}</figcaption>
      <div
        class="relative h-[290px]"
        ref={host}
        style={{ cursor: tip ? "pointer" : "" }}
        onPointerMove={(event) => highlight(nearest(event)?.id ?? null)}
        onPointerLeave={() => highlight(null)}
        onClick={(event) => {
          // A screen reader's click may have no coordinates.
          const id = nearest(event)?.id ?? idOf(event.target);
          if (id !== null) session.select(id);
        }}
        onFocusIn={(event) => highlight(idOf(event.target))}
        onFocusOut={() => highlight(null)}
      >
        <svg class="absolute inset-0 size-full overflow-visible" role="group" aria-label={title} ref={overlay}>
          {placed.map((mark, index) => (
            <MarkButton key={mark.id} mark={mark} state={props} isTabStop={mark.id === stop} onKey={(event) => onKey(event, index)} />
          ))}
          <Labels placed={placed} props={props} size={size} />
        </svg>
        {tip && <Tip mark={tip} width={size.width} />}
      </div>
    </figure>
  );
}

/** Axes, curves, front and quartile bars, on uPlot's canvas. */
function useCurves(host: { current: HTMLDivElement | null }, { marks, curves, axes, session }: DiagramProps, size: { width: number; height: number }) {
  const plot = useRef<uPlot | null>(null);
  const paint = useRef<(u: uPlot) => void>(() => undefined);
  const [emphasised, current, highlighted] = [session.curve.value, currentOf(session), session.highlighted.value];
  paint.current = (u) => drawCurves(u, marks, curves, emphasised, new Set([current, highlighted]));
  const { x, y, xLabel, yLabel } = axes;
  useLayoutEffect(() => {
    const node = host.current;
    if (node === null || size.width === 0) return;
    const series = [{}, { paths: () => null, points: { show: false } }];
    const made = new uPlot(plotOptions(size, { x, y, xLabel, yLabel }, series, (u) => paint.current(u)), [[], []], node);
    plot.current = made;
    return () => made.destroy();
  }, [host, size, x, y, xLabel, yLabel]);
  useLayoutEffect(() => plot.current?.redraw(false), [marks, curves, emphasised, current, highlighted]);
}

function drawCurves(u: uPlot, marks: readonly Ranked[], curves: readonly Curve[], emphasised: string, lit: ReadonlySet<string | null>): void {
  const { ctx } = u;
  const byId = new Map(marks.map((mark) => [mark.id, mark]));
  const at = ({ time, error }: { time: number; error: number }) => [u.valToPos(time, "x", true), u.valToPos(error, "y", true)] as const;
  const line = (points: readonly Ranked[], colour: string, width: number, dash: number[] = []) => {
    ctx.beginPath();
    for (const point of points) ctx.lineTo(...at(point));
    ctx.strokeStyle = colour;
    ctx.lineWidth = width * devicePixelRatio;
    ctx.setLineDash(dash.map((length) => length * devicePixelRatio));
    ctx.stroke();
  };
  ctx.save();
  ctx.lineJoin = "round";
  for (const { pointer, points } of curves) {
    const known = points.flatMap(({ id }) => byId.get(id) ?? []);
    if (pointer === emphasised) line(known, INK.teal, 2.5);
    else line(known, "rgb(127 196 192 / 32%)", 1);
  }
  line(marks.filter(({ onFront }) => onFront), INK.pale, 1, [3, 4]);
  line(marks.filter(isTier), INK.accent, 2);
  for (const mark of marks) {
    const ends = [mark.low, mark.high].map((time) => ({ ...mark, time }));
    line(ends, lit.has(mark.id) ? "rgb(234 241 243 / 90%)" : "rgb(210 226 234 / 38%)", 1.2);
    ctx.beginPath();
    for (const [x, y] of ends.map(at)) {
      ctx.moveTo(x, y - 3 * devicePixelRatio);
      ctx.lineTo(x, y + 3 * devicePixelRatio);
    }
    ctx.stroke();
  }
  ctx.restore();
}

function MarkButton({ mark, state, isTabStop, onKey }: { mark: PlacedMark; state: DiagramProps; isTabStop: boolean; onKey: (event: KeyboardEvent) => void }) {
  const { session, fitting } = state;
  const { id, point, onFront, x, y } = mark;
  const tier = isTier(mark);
  const states = { tier, "on-front": onFront, current: id === currentOf(session), highlighted: id === session.highlighted.value, over: fitting?.has(id) === false };
  const classes = Object.entries(states).flatMap(([name, on]) => (on ? name : []));
  return (
    <g
      class={["mark group outline-none [&.over]:opacity-35", ...classes].join(" ")}
      role="button"
      tabindex={isTabStop ? 0 : -1}
      data-id={id}
      aria-pressed={states.current}
      aria-label={`${point.label}: ${describe(mark)}${onFront ? ", on the Pareto front" : ""}`}
      onKeyDown={onKey}
    >
      <circle
        class={`halo stroke-[1.5] group-focus-visible:stroke-accent group-focus-visible:stroke-3 ${states.highlighted ? "fill-tint" : "fill-[transparent]"} ${states.current ? "stroke-accent" : "stroke-none"}`}
        cx={x}
        cy={y}
        r={11}
      />
      <circle class={`dot stroke-[rgb(8_17_26/85%)] stroke-[1.5] ${states.current ? "fill-accent" : tier ? "fill-ink" : "fill-teal"}`} cx={x} cy={y} r={tier ? 5.5 : 4} />
    </g>
  );
}

/** Names of the tiers, and the values of the emphasised curve. */
function Labels({ placed, props: { curves, session }, size }: { placed: readonly PlacedMark[]; props: DiagramProps; size: { width: number; height: number } }) {
  const values = new Map(curves.find(({ pointer }) => pointer === session.curve.value)?.points.map(({ id, value }) => [id, value]));
  const named = placed.flatMap((mark) => {
    const text = isTier(mark) ? mark.point.label : values.get(mark.id);
    return text === undefined ? [] : { ...mark, text };
  });
  const tiers = placed.filter(isTier);
  const onLine = tiers.slice(1).flatMap((mark, i) => between(tiers[i] ?? mark, mark));
  return (
    <>
      {placeLabels(named, [...placed, ...onLine], size.width, size.height).map(({ id, text, x, y, anchor }) => (
        <text key={id} class={`${values.has(id) && text === values.get(id) ? "value fill-teal" : "name fill-ink"} stroke-[rgb(8_17_26/90%)] stroke-3 text-small [paint-order:stroke]`} x={x} y={y} text-anchor={anchor} aria-hidden="true">
          {text}
        </text>
      ))}
    </>
  );
}

/** Points of a line that labels should not cover. */
function between(from: PlacedMark, to: PlacedMark) {
  const share = (i: number, a: number, b: number) => a + ((b - a) * i) / 16;
  return Array.from({ length: 15 }, (_, i) => ({ id: "", x: share(i + 1, from.x, to.x), y: share(i + 1, from.y, to.y) }));
}

function Tip({ mark, width }: { mark: PlacedMark; width: number }) {
  const tip = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const node = tip.current;
    if (node === null) return;
    const half = node.offsetWidth / 2;
    node.style.left = `${Math.min(width - half - 2, Math.max(half + 2, mark.x))}px`;
    const above = mark.y - node.offsetHeight - 14;
    node.style.top = `${above >= 0 ? above : mark.y + 16}px`;
  });
  return (
    <div class="tip pointer-events-none absolute z-1 grid w-max max-w-60 -translate-x-1/2 rounded-md bg-[rgb(4_10_16/94%)] px-2.5 py-1.5 text-fine inset-ring inset-ring-line" aria-hidden="true" ref={tip}>
      <b>{mark.point.label}</b>
      <span>{describe(mark)}</span>
    </div>
  );
}

function idOf(target: EventTarget | null): string | null {
  return target instanceof SVGElement ? (target.closest<SVGElement>(".mark")?.dataset["id"] ?? null) : null;
}
