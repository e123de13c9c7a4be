/** Time against error: a mark for every quality, a line through what is worth having. */
import { element } from "../ui/dom";
import { axis } from "./axis";
import { type Cost, front, short } from "./compare";

export interface Mark extends Cost {
  label: string;
  /** Whether it is named in the chart. */
  tier: boolean;
  /** Quartiles of the time, ms. */
  low: number;
  high: number;
}

export interface ChartData {
  marks: readonly Mark[];
  /** What the server measured; drawn hollow. */
  server: readonly Mark[];
  /** What the page runs now. */
  current: string | null;
}

export interface ChartEvents {
  choose(id: string): void;
  /** Which mark is looked at; null: none. */
  look(id: string | null): void;
}

const SVG = "http://www.w3.org/2000/svg";
const MARGIN = { left: 40, right: 14, top: 26, bottom: 38 };
/** How near a pointer must come, px. */
const REACH = 26;
/** Least distance of the words at an axis, px. */
const APART = { x: 34, y: 18 };

interface Placed extends Mark {
  x: number;
  y: number;
}

export class Chart {
  readonly root = element("div", { class: "chart" });
  private readonly svg = make("svg", { role: "group", "aria-label": "Time against error of every quality" });
  private readonly tip = element("div", { class: "tip", "aria-hidden": "true", hidden: true });
  private data: ChartData = { marks: [], server: [], current: null };
  private placed: Placed[] = [];
  private looked: string | null = null;
  /** The mark that the tabulator reaches; arrows go on from there. */
  private stop: string | null = null;

  constructor(private readonly events: ChartEvents) {
    this.root.append(this.svg, this.tip);
    this.svg.addEventListener("pointermove", (event) => this.look(this.nearest(event)?.id ?? null));
    this.svg.addEventListener("pointerleave", () => this.look(null));
    this.svg.addEventListener("click", (event) => {
      // A screen reader's click may come without a place.
      const id = this.nearest(event)?.id ?? idOf(event.target);
      if (id !== null) this.events.choose(id);
    });
    this.svg.addEventListener("focusin", (event) => this.look(idOf(event.target)));
    this.svg.addEventListener("focusout", () => this.look(null));
    this.svg.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.draw()).observe(this.root);
  }

  show(data: ChartData): void {
    this.data = data;
    this.draw();
  }

  private draw(): void {
    const { marks, server, current } = this.data;
    const width = this.root.clientWidth;
    const height = this.root.clientHeight;
    if (width === 0 || height === 0) return;
    const focused = this.svg.contains(document.activeElement) ? idOf(document.activeElement) : null;
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const [w, h] = [width - MARGIN.left - MARGIN.right, height - MARGIN.top - MARGIN.bottom];
    const all = [...marks, ...server];
    const [across, up] = [axis(all.map(({ time }) => time)), axis(all.map(({ error }) => error))];
    const x = (value: number) => MARGIN.left + w * across.at(value);
    const y = (value: number) => MARGIN.top + h * (1 - up.at(value));
    const place = (mark: Mark): Placed => ({ ...mark, x: x(mark.time), y: y(mark.error) });
    this.placed = marks.map(place).sort((a, b) => a.time - b.time);
    const others = server.map(place);

    const parts: SVGElement[] = [];
    let last = -Infinity;
    for (const tick of across.ticks) {
      const at = x(tick);
      parts.push(make("line", { class: "grid", x1: at, x2: at, y1: MARGIN.top, y2: MARGIN.top + h }));
      if (at - last < APART.x || all.length === 0) continue;
      last = at;
      parts.push(text(at, MARGIN.top + h + 15, plain(tick), "tick", "middle"));
    }
    last = Infinity;
    for (const tick of up.ticks) {
      const at = y(tick);
      parts.push(make("line", { class: "grid", x1: MARGIN.left, x2: MARGIN.left + w, y1: at, y2: at }));
      if (last - at < APART.y || all.length === 0) continue;
      last = at;
      parts.push(text(MARGIN.left - 7, at + 3.5, plain(tick), "tick", "end"));
    }
    parts.push(text(2, 12, "↑ error, levels of 255", "axis", "start"));
    parts.push(text(MARGIN.left + w, height - 4, "ms a frame →", "axis", "end"));

    parts.push(line(front(others).map(({ x: a, y: b }) => [a, b]), "front server"));
    parts.push(line(front(this.placed).map(({ x: a, y: b }) => [a, b]), "front"));
    for (const mark of others) {
      const ring = make("circle", { class: "server", cx: mark.x, cy: mark.y, r: mark.tier ? 5 : 3.5 });
      ring.append(title(`${mark.label}, on the server: ${numbers(mark)}`));
      parts.push(ring);
    }
    const best = new Set(front(this.placed).map(({ id }) => id));
    this.stop = this.placed.find(({ id }) => id === (focused ?? this.stop))?.id ?? current ?? this.placed[0]?.id ?? null;
    for (const mark of this.placed) {
      const kinds = [mark.tier ? "tier" : "knob", best.has(mark.id) ? "best" : "", mark.id === current ? "current" : ""];
      const button = make("g", {
        class: `mark ${kinds.filter(Boolean).join(" ")}`,
        role: "button",
        tabindex: mark.id === this.stop ? 0 : -1,
        "data-id": mark.id,
        "aria-pressed": String(mark.id === current),
        "aria-label": `${mark.label}: ${numbers(mark)}${best.has(mark.id) ? ", on the front" : ""}`,
      });
      button.append(
        make("line", { class: "spread", x1: x(mark.low), x2: x(mark.high), y1: mark.y, y2: mark.y }),
        make("circle", { class: "halo", cx: mark.x, cy: mark.y, r: 11 }),
        make("circle", { class: "dot", cx: mark.x, cy: mark.y, r: mark.tier ? 5.5 : 4 }),
        title(`${mark.label}: ${numbers(mark)}`),
      );
      parts.push(button);
    }
    parts.push(...names(this.placed, others, width, height));
    this.svg.replaceChildren(...parts);
    if (focused !== null) this.button(focused)?.focus();
    this.point();
  }

  private button(id: string): SVGElement | undefined {
    return [...this.svg.querySelectorAll<SVGElement>(".mark")].find((mark) => mark.dataset["id"] === id);
  }

  private nearest({ clientX, clientY }: MouseEvent): Placed | undefined {
    const box = this.svg.getBoundingClientRect();
    const distance = (mark: Placed) => Math.hypot(mark.x - (clientX - box.left), mark.y - (clientY - box.top));
    return this.placed.filter((mark) => distance(mark) <= REACH).sort((a, b) => distance(a) - distance(b))[0];
  }

  private key(event: KeyboardEvent): void {
    const id = idOf(event.target);
    if (id === null) return;
    if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      this.events.choose(id);
      return;
    }
    const at = this.placed.findIndex((mark) => mark.id === id);
    const to = { ArrowLeft: at - 1, ArrowDown: at - 1, ArrowRight: at + 1, ArrowUp: at + 1, Home: 0, End: this.placed.length - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    const next = this.placed[Math.min(this.placed.length - 1, Math.max(0, to))];
    if (next === undefined) return;
    this.button(id)?.setAttribute("tabindex", "-1");
    this.stop = next.id;
    const button = this.button(next.id);
    button?.setAttribute("tabindex", "0");
    button?.focus();
  }

  private look(id: string | null): void {
    if (id === this.looked) return;
    this.looked = id;
    this.point();
    this.events.look(id);
  }

  /** Shows which mark is looked at. */
  private point(): void {
    const mark = this.placed.find(({ id }) => id === this.looked);
    for (const button of this.svg.querySelectorAll<SVGElement>(".mark")) {
      button.classList.toggle("looked", button.dataset["id"] === mark?.id);
    }
    this.svg.style.cursor = mark ? "pointer" : "";
    this.tip.hidden = mark === undefined;
    if (mark === undefined) return;
    this.tip.replaceChildren(element("b", {}, mark.label), element("span", {}, numbers(mark)));
    const { clientWidth: width } = this.root;
    const half = this.tip.offsetWidth / 2;
    this.tip.style.left = `${Math.min(width - half - 2, Math.max(half + 2, mark.x))}px`;
    const above = mark.y - this.tip.offsetHeight - 14;
    this.tip.style.top = `${above >= 0 ? above : mark.y + 16}px`;
  }
}

function numbers({ time, error }: Cost): string {
  return `${short(time)} ms, error ${short(error)}`;
}

/** Names beside the tiers' marks, where they cover the fewest marks and no other name. */
function names(placed: readonly Placed[], others: readonly Placed[], width: number, height: number): SVGElement[] {
  const boxes: [number, number, number, number][] = [];
  const marks = [...placed, ...others];
  return placed
    .filter(({ tier }) => tier)
    .map((mark) => {
      const long = 6.4 * mark.label.length;
      const choices = [
        { x: mark.x + 11, y: mark.y + 4, anchor: "start" },
        { x: mark.x - 11, y: mark.y + 4, anchor: "end" },
        { x: mark.x, y: mark.y - 12, anchor: "middle" },
        { x: mark.x, y: mark.y + 21, anchor: "middle" },
        { x: mark.x + 9, y: mark.y - 9, anchor: "start" },
        { x: mark.x + 9, y: mark.y + 17, anchor: "start" },
        { x: mark.x - 9, y: mark.y - 9, anchor: "end" },
        { x: mark.x - 9, y: mark.y + 17, anchor: "end" },
      ].map((choice) => {
        const left = choice.x - { start: 0, middle: long / 2, end: long }[choice.anchor as "start" | "middle" | "end"];
        const box: [number, number, number, number] = [left, choice.y - 11, left + long, choice.y + 3];
        const outside = box[0] < 4 || box[2] > width - 2 || box[1] < 14 || box[3] > height - 24;
        const crossing = boxes.filter((b) => box[0] < b[2] && b[0] < box[2] && box[1] < b[3] && b[1] < box[3]).length;
        const covered = marks.filter((m) => m.id !== mark.id && m.x > box[0] - 5 && m.x < box[2] + 5 && m.y > box[1] - 5 && m.y < box[3] + 5);
        return { ...choice, box, cost: (outside ? 100 : 0) + 20 * crossing + covered.length };
      });
      const best = choices.reduce((a, b) => (b.cost < a.cost ? b : a));
      boxes.push(best.box);
      return text(best.x, best.y, mark.label, "name", best.anchor);
    });
}

function make(name: string, attributes: Record<string, string | number>): SVGSVGElement {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  return made as SVGSVGElement;
}

function text(x: number, y: number, words: string, kind: string, anchor: string): SVGElement {
  const made = make("text", { x, y, class: kind, "text-anchor": anchor, "aria-hidden": "true" });
  made.textContent = words;
  return made;
}

function title(words: string): SVGElement {
  const made = make("title", {});
  made.textContent = words;
  return made;
}

function line(points: readonly (readonly [number, number])[], kind: string): SVGElement {
  return make("polyline", { class: kind, points: points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(" ") });
}

function plain(value: number): string {
  return value >= 1000 ? `${value / 1000}k` : String(value);
}

function idOf(target: EventTarget | null): string | null {
  return target instanceof SVGElement ? (target.closest<SVGElement>(".mark")?.dataset["id"] ?? null) : null;
}
