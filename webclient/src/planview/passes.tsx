/** Passes of a plan: two small graphs, of what is drawn once and of what is drawn in every frame, and a table. */
import { Table } from "../charts/parts";
import type { FramePlan, Pass } from "../generated/api";
import { targetSize } from "../gl/resources";
import { targetsRead } from "../plan/view";

interface GraphNode {
  program: string;
  when: "setup" | "frame";
  passes: number[]; // Indices of its passes
  column: number;
  row: number;
  reads: Set<GraphNode>; // Nodes that it reads
}

interface Graph { nodes: GraphNode[]; columns: number; rows: number; }

/** Graph of the passes of one kind; what the other kind draws is not part of it. */
export function graphOf(plan: Pick<FramePlan, "passes">, when: GraphNode["when"]): Graph {
  const nodes = new Map<string, GraphNode>();
  const writers = new Map<string, Set<GraphNode>>();
  const filled: number[] = [];
  plan.passes.forEach((pass, index) => {
    if (pass.when !== when) return;
    const sources = targetsRead(pass).flatMap((name) => [...(writers.get(name) ?? [])]);
    let node = nodes.get(pass.program);
    if (node === undefined) {
      // The column follows from the first pass: passes that feed each other would have none otherwise.
      const column = Math.max(-1, ...sources.map((source) => source.column)) + 1;
      const row = filled[column] ?? 0;
      filled[column] = row + 1;
      node = { program: pass.program, when, passes: [], column, row, reads: new Set() };
      nodes.set(pass.program, node);
    }
    node.passes.push(index);
    for (const source of sources) if (source !== node) node.reads.add(source);
    const written = writers.get(pass.target) ?? new Set();
    writers.set(pass.target, written.add(node));
  });
  return { nodes: [...nodes.values()], columns: filled.length, rows: Math.max(0, ...filled) };
}

/** Size and format of a target in a picture of that size. */
export function targetText(plan: Pick<FramePlan, "targets">, name: string, width: number, height: number): { size: string; format: string } {
  const spec = plan.targets[name];
  if (spec === undefined) return { size: `${width} × ${height}`, format: "RGBA8" };
  const [w, h] = targetSize(spec, width, height);
  return { size: `${w} × ${h}${spec.layers > 1 ? ` × ${spec.layers}` : ""}`, format: spec.depth ? `${spec.format}, depth` : spec.format };
}

const NODE = { width: 138, height: 52 };
const GAP = { x: 30, y: 10 };
const DETAIL = "fill-soft stroke-none text-[10.5px]";
const CELLS = "[&_:is(th,td)]:border-b [&_:is(th,td)]:border-line [&_:is(th,td)]:px-3 [&_:is(th,td)]:py-1 [&_:is(th,td)]:text-left";
const LONGEST_LABEL = 19;

interface PassesProps {
  plan: FramePlan;
  width: number;
  height: number;
  times: ReadonlyMap<Pass, number> | null; // ms by pass; null: not measured
  choose: (program: string) => void;
}

const place = ({ column, row }: GraphNode) => ({ x: column * (NODE.width + GAP.x), y: row * (NODE.height + GAP.y) });
const shortened = (text: string) => (text.length > LONGEST_LABEL ? `${text.slice(0, LONGEST_LABEL - 1)}…` : text);

/** Sum of the times of these passes, ms; an empty text if none was measured. */
function timeText(times: PassesProps["times"], passes: readonly (Pass | undefined)[]): string {
  const known = passes.flatMap((pass) => (pass && times?.has(pass) ? [times.get(pass) ?? 0] : []));
  return known.length === 0 ? "" : `${known.reduce((sum, time) => sum + time, 0).toFixed(3)} ms`;
}

function Node({ node, props: { plan, width, height, times, choose } }: { node: GraphNode; props: PassesProps }) {
  const { x, y } = place(node);
  const passes = node.passes.map((index) => plan.passes[index]);
  const last = passes.at(-1);
  const target = targetText(plan, last?.target ?? "screen", width, height);
  const count = node.passes.length > 1 ? ` × ${node.passes.length}` : "";
  return (
    <g class="node group cursor-pointer" transform={`translate(${x} ${y})`} onClick={() => choose(node.program)}>
      <title>{`${node.program}${count}: ${target.size}, ${target.format}`}</title>
      <rect class="fill-[#10212e] stroke-line group-hover:stroke-accent in-[.kind.frame]:fill-[#16303f]" width={NODE.width} height={NODE.height} rx="8" />
      <text x="10" y="18" class="name fill-ink stroke-none text-small">{shortened(node.program + count)}</text>
      <text x="10" y="32" class={DETAIL}>{target.size}</text>
      <text x="10" y="45" class={DETAIL}>{[target.format, timeText(times, passes)].filter(Boolean).join(" · ")}</text>
    </g>
  );
}

function edge(from: GraphNode, to: GraphNode): string {
  const a = place(from);
  const b = place(to);
  const [x1, y1, x2, y2] = [a.x + NODE.width, a.y + NODE.height / 2, b.x, b.y + NODE.height / 2];
  const bend = Math.max(14, Math.abs(x2 - x1) / 2);
  return `M${x1} ${y1}C${x1 + bend} ${y1} ${x2 - bend} ${y2} ${x2} ${y2}`;
}

function GraphPicture({ graph, label, props }: { graph: Graph; label: string; props: PassesProps }) {
  const width = graph.columns * (NODE.width + GAP.x) - GAP.x;
  const height = graph.rows * (NODE.height + GAP.y) - GAP.y;
  return (
    <div class="max-h-80 overflow-auto rounded-lg border border-line bg-[rgb(0_0_0/25%)] p-3" tabIndex={0} role="group" aria-label={label}>
      <svg class="max-w-none [stroke-width:1.2]" style={{ width: width + 2, height: height + 2 }} viewBox={`-1 -1 ${width + 2} ${height + 2}`} role="img" aria-label={`${label}; the table below lists the same`}>
        {graph.nodes.flatMap((node) => [...node.reads].map((source) => <path class="stroke-[rgb(190_220_235/32%)]" key={`${source.program} ${node.program}`} d={edge(source, node)} />))}
        {graph.nodes.map((node) => <Node key={node.program} node={node} props={props} />)}
      </svg>
    </div>
  );
}

function Row({ pass, props: { plan, width, height, times, choose } }: { pass: Pass; props: PassesProps }) {
  const { size, format } = targetText(plan, pass.target, width, height);
  const { blend, depth } = pass.state;
  const state = [pass.eye === "any" ? "" : `camera ${pass.eye.join(" or ")}`, blend === "none" ? "" : blend, depth ? "depth test" : ""].filter(Boolean).join(", ");
  return (
    <tr>
      <td>{pass.name}</td>
      <td><button type="button" class="pill rounded-md px-2.5" onClick={() => choose(pass.program)}>{pass.program}</button></td>
      <td>{pass.target}</td>
      <td>{size}</td>
      <td>{format}</td>
      <td>{state}</td>
      <td>{timeText(times, [pass])}</td>
    </tr>
  );
}

export function Passes(props: PassesProps) {
  const { plan } = props;
  const kinds = [
    { when: "frame", title: "In every frame" },
    { when: "setup", title: "Kept: not drawn in every frame" },
  ] as const;
  return (
    <>
      {kinds.map(({ when, title }) => {
        const passes = plan.passes.filter((pass) => pass.when === when);
        if (passes.length === 0) return null;
        return (
          <section key={when} class={`kind ${when}`}>
            <h3>{title}: {passes.length} {passes.length === 1 ? "pass" : "passes"}</h3>
            <GraphPicture graph={graphOf(plan, when)} label={title} props={props} />
            <details>
              <summary class="min-h-11 cursor-pointer content-center text-soft">Table of the passes</summary>
              <div class="overflow-auto rounded-lg border border-line" tabIndex={0} role="group" aria-label={`${title}, table`}>
                <Table look={CELLS} class="text-small whitespace-nowrap" heads={["pass", "program", "target", "size", "format", "state", "time"]}>
                  {passes.map((pass, index) => <Row key={index} pass={pass} props={props} />)}
                </Table>
              </div>
            </details>
          </section>
        );
      })}
    </>
  );
}
