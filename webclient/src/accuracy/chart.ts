/** Scatter plot of frame time and error: a mark for each quality, a line through the Pareto front. */
import { element } from "../ui/dom";
import { logAxis } from "./axis";
import { formatNumber } from "./format";
import { type Cost, paretoFront } from "./statistics";

export interface Mark extends Cost {
  label: string;
  /** Tiers are labelled in the chart. */
  isTier: boolean;
  /** Quartiles of the time, ms. */
  low: number;
  high: number;
}

export interface ChartData {
  marks: readonly Mark[];
  /** The server's measurement; drawn as rings. */
  server: readonly Mark[];
  /** Id of the quality that the page runs. */
  current: string | null;
}

export interface ChartEvents {
  select(id: string): void;
  /** The mark under the pointer or with focus; null: none. */
  highlight(id: string | null): void;
}

const SVG = "http://www.w3.org/2000/svg";
const MARGIN = { left: 40, right: 14, top: 26, bottom: 38 };
/** Greatest distance of the pointer from a mark, px. */
const HIT_RADIUS = 26;
/** Least distance of tick labels, px. */
const TICK_SPACING = { x: 34, y: 18 };

interface PlacedMark extends Mark {
  x: number;
  y: number;
}

type Plot = ReturnType<typeof makePlot>;

export class Chart {
  readonly root = element("div", { class: "chart" });
  private readonly svg = svg("svg", { role: "group", "aria-label": "Frame time and error of every quality" });
  private readonly tip = element("div", { class: "tip", "aria-hidden": "true", hidden: true });
  private data: ChartData = { marks: [], server: [], current: null };
  private marks: PlacedMark[] = [];
  private highlighted: string | null = null;
  /** Id of the mark in the tab order; arrow keys move from it. */
  private tabStop: string | null = null;

  constructor(private readonly events: ChartEvents) {
    this.root.append(this.svg, this.tip);
    this.svg.addEventListener("pointermove", (event) => this.highlight(this.nearest(event)?.id ?? null));
    this.svg.addEventListener("pointerleave", () => this.highlight(null));
    this.svg.addEventListener("click", (event) => {
      // A screen reader's click may have no coordinates.
      const id = this.nearest(event)?.id ?? idOf(event.target);
      if (id !== null) this.events.select(id);
    });
    this.svg.addEventListener("focusin", (event) => this.highlight(idOf(event.target)));
    this.svg.addEventListener("focusout", () => this.highlight(null));
    this.svg.addEventListener("keydown", (event) => this.handleKey(event));
    new ResizeObserver(() => this.draw()).observe(this.root);
  }

  show(data: ChartData): void {
    this.data = data;
    this.draw();
  }

  private draw(): void {
    const { marks, server, current } = this.data;
    const { clientWidth: width, clientHeight: height } = this.root;
    if (width === 0 || height === 0) return;
    const focused = this.svg.contains(document.activeElement) ? idOf(document.activeElement) : null;
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const plot = makePlot([...marks, ...server], width, height);
    const place = (mark: Mark): PlacedMark => ({ ...mark, x: plot.x(mark.time), y: plot.y(mark.error) });
    this.marks = marks.map(place).sort((a, b) => a.time - b.time);
    const serverMarks = server.map(place);
    const front = paretoFront(this.marks);
    const onFront = new Set(front.map(({ id }) => id));
    this.tabStop = this.marks.find(({ id }) => id === (focused ?? this.tabStop))?.id ?? current ?? this.marks[0]?.id ?? null;
    this.svg.replaceChildren(
      ...axisParts(plot, marks.length + server.length > 0),
      polyline(paretoFront(serverMarks), "front server"),
      polyline(front, "front"),
      ...serverMarks.map(serverRing),
      ...this.marks.map((mark) => markButton(mark, plot, onFront.has(mark.id), mark.id === current, mark.id === this.tabStop)),
      ...tierLabels(this.marks, serverMarks, width, height),
    );
    if (focused !== null) this.button(focused)?.focus();
    this.showHighlight();
  }

  private button(id: string): SVGElement | undefined {
    return [...this.svg.querySelectorAll<SVGElement>(".mark")].find((mark) => mark.dataset["id"] === id);
  }

  private nearest({ clientX, clientY }: MouseEvent): PlacedMark | undefined {
    const box = this.svg.getBoundingClientRect();
    const distance = (mark: PlacedMark) => Math.hypot(mark.x - (clientX - box.left), mark.y - (clientY - box.top));
    return this.marks.filter((mark) => distance(mark) <= HIT_RADIUS).sort((a, b) => distance(a) - distance(b))[0];
  }

  private handleKey(event: KeyboardEvent): void {
    const id = idOf(event.target);
    if (id === null) return;
    if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      this.events.select(id);
      return;
    }
    const last = this.marks.length - 1;
    const index = this.marks.findIndex((mark) => mark.id === id);
    const target = { ArrowLeft: index - 1, ArrowDown: index - 1, ArrowRight: index + 1, ArrowUp: index + 1, Home: 0, End: last }[event.key];
    if (target === undefined) return;
    event.preventDefault();
    const next = this.marks[Math.min(last, Math.max(0, target))];
    if (next === undefined) return;
    this.button(id)?.setAttribute("tabindex", "-1");
    this.tabStop = next.id;
    const button = this.button(next.id);
    button?.setAttribute("tabindex", "0");
    button?.focus();
  }

  private highlight(id: string | null): void {
    if (id === this.highlighted) return;
    this.highlighted = id;
    this.showHighlight();
    this.events.highlight(id);
  }

  private showHighlight(): void {
    const mark = this.marks.find(({ id }) => id === this.highlighted);
    for (const button of this.svg.querySelectorAll<SVGElement>(".mark")) {
      button.classList.toggle("highlighted", button.dataset["id"] === mark?.id);
    }
    this.svg.style.cursor = mark ? "pointer" : "";
    this.tip.hidden = mark === undefined;
    if (mark === undefined) return;
    this.tip.replaceChildren(element("b", {}, mark.label), element("span", {}, describe(mark)));
    const { clientWidth: width } = this.root;
    const half = this.tip.offsetWidth / 2;
    this.tip.style.left = `${Math.min(width - half - 2, Math.max(half + 2, mark.x))}px`;
    const above = mark.y - this.tip.offsetHeight - 14;
    this.tip.style.top = `${above >= 0 ? above : mark.y + 16}px`;
  }
}

function makePlot(marks: readonly Mark[], width: number, height: number) {
  const [left, right, top, bottom] = [MARGIN.left, width - MARGIN.right, MARGIN.top, height - MARGIN.bottom];
  const [timeAxis, errorAxis] = [logAxis(marks.map(({ time }) => time)), logAxis(marks.map(({ error }) => error))];
  return {
    ...{ left, right, top, bottom },
    x: (time: number) => left + (right - left) * timeAxis.position(time),
    y: (error: number) => bottom - (bottom - top) * errorAxis.position(error),
    xTicks: timeAxis.ticks,
    yTicks: errorAxis.ticks,
  };
}

/** Grid, tick labels and titles of both axes. */
function axisParts({ left, right, top, bottom, x, y, xTicks, yTicks }: Plot, withLabels: boolean): SVGElement[] {
  const parts: SVGElement[] = [];
  let previous = -Infinity;
  for (const tick of xTicks) {
    const tickX = x(tick);
    parts.push(svg("line", { class: "grid", x1: tickX, x2: tickX, y1: top, y2: bottom }));
    if (tickX - previous < TICK_SPACING.x || !withLabels) continue;
    previous = tickX;
    parts.push(text(tickX, bottom + 15, tickLabel(tick), "tick", "middle"));
  }
  previous = Infinity;
  for (const tick of yTicks) {
    const tickY = y(tick);
    parts.push(svg("line", { class: "grid", x1: left, x2: right, y1: tickY, y2: tickY }));
    if (previous - tickY < TICK_SPACING.y || !withLabels) continue;
    previous = tickY;
    parts.push(text(left - 7, tickY + 3.5, tickLabel(tick), "tick", "end"));
  }
  parts.push(text(2, 12, "↑ RMSE, levels of 255", "axis", "start"));
  parts.push(text(right, bottom + MARGIN.bottom - 4, "frame time, ms →", "axis", "end"));
  return parts;
}

function serverRing(mark: PlacedMark): SVGElement {
  const ring = svg("circle", { class: "server", cx: mark.x, cy: mark.y, r: mark.isTier ? 5 : 3.5 });
  ring.append(title(`${mark.label}, on the server: ${describe(mark)}`));
  return ring;
}

function markButton(mark: PlacedMark, plot: Plot, onFront: boolean, isCurrent: boolean, isTabStop: boolean): SVGElement {
  const classes = ["mark", mark.isTier ? "tier" : "", onFront ? "on-front" : "", isCurrent ? "current" : ""];
  const button = svg("g", {
    class: classes.filter(Boolean).join(" "),
    role: "button",
    tabindex: isTabStop ? 0 : -1,
    "data-id": mark.id,
    "aria-pressed": String(isCurrent),
    "aria-label": `${mark.label}: ${describe(mark)}${onFront ? ", on the Pareto front" : ""}`,
  });
  button.append(
    svg("line", { class: "quartiles", x1: plot.x(mark.low), x2: plot.x(mark.high), y1: mark.y, y2: mark.y }),
    svg("circle", { class: "halo", cx: mark.x, cy: mark.y, r: 11 }),
    svg("circle", { class: "dot", cx: mark.x, cy: mark.y, r: mark.isTier ? 5.5 : 4 }),
    title(`${mark.label}: ${describe(mark)}`),
  );
  return button;
}

function describe({ time, error }: Cost): string {
  return `${formatNumber(time)} ms, error ${formatNumber(error)}`;
}

/** Labels of the tiers, placed to cover the fewest marks and no other label. */
function tierLabels(marks: readonly PlacedMark[], serverMarks: readonly PlacedMark[], width: number, height: number): SVGElement[] {
  const placed: [number, number, number, number][] = [];
  const obstacles = [...marks, ...serverMarks];
  return marks
    .filter(({ isTier }) => isTier)
    .map(({ id, x, y, label }) => {
      const length = 6.4 * label.length;
      const candidates = [
        { x: x + 11, y: y + 4, anchor: "start" },
        { x: x - 11, y: y + 4, anchor: "end" },
        { x, y: y - 12, anchor: "middle" },
        { x, y: y + 21, anchor: "middle" },
        { x: x + 9, y: y - 9, anchor: "start" },
        { x: x + 9, y: y + 17, anchor: "start" },
        { x: x - 9, y: y - 9, anchor: "end" },
        { x: x - 9, y: y + 17, anchor: "end" },
      ].map((candidate) => {
        const left = candidate.x - { start: 0, middle: length / 2, end: length }[candidate.anchor as "start" | "middle" | "end"];
        const box: [number, number, number, number] = [left, candidate.y - 11, left + length, candidate.y + 3];
        const outside = box[0] < 4 || box[2] > width - 2 || box[1] < 14 || box[3] > height - 24;
        const crossed = placed.filter((b) => box[0] < b[2] && b[0] < box[2] && box[1] < b[3] && b[1] < box[3]).length;
        const covered = obstacles.filter((m) => m.id !== id && m.x > box[0] - 5 && m.x < box[2] + 5 && m.y > box[1] - 5 && m.y < box[3] + 5).length;
        return { ...candidate, box, penalty: (outside ? 100 : 0) + 20 * crossed + covered };
      });
      const best = candidates.reduce((a, b) => (b.penalty < a.penalty ? b : a));
      placed.push(best.box);
      return text(best.x, best.y, label, "name", best.anchor);
    });
}

function svg(name: string, attributes: Record<string, string | number>): SVGSVGElement {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, String(value));
  return node as SVGSVGElement;
}

function text(x: number, y: number, content: string, kind: string, anchor: string): SVGElement {
  const node = svg("text", { x, y, class: kind, "text-anchor": anchor, "aria-hidden": "true" });
  node.textContent = content;
  return node;
}

function title(content: string): SVGElement {
  const node = svg("title", {});
  node.textContent = content;
  return node;
}

function polyline(points: readonly PlacedMark[], kind: string): SVGElement {
  return svg("polyline", { class: kind, points: points.map(({ x, y }) => `${x.toFixed(1)},${y.toFixed(1)}`).join(" ") });
}

function tickLabel(value: number): string {
  return value >= 1000 ? `${value / 1000}k` : String(value);
}

function idOf(target: EventTarget | null): string | null {
  return target instanceof SVGElement ? (target.closest<SVGElement>(".mark")?.dataset["id"] ?? null) : null;
}
