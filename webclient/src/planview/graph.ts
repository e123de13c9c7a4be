/** A plan's passes as a small graph: passes with one program are one node, placed in columns after what they read. */
import type { FramePlan } from "../generated/api";
import { targetSize } from "../gl/target";
import { targetsRead } from "../plan/view";

export interface GraphNode {
  program: string;
  when: "setup" | "frame";
  /** Indices of its passes. */
  passes: number[];
  column: number;
  row: number;
  /** Nodes that it reads. */
  reads: Set<GraphNode>;
}

export interface Graph { nodes: GraphNode[]; columns: number; rows: number; }

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
