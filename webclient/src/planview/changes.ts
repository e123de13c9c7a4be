/** What is different between two plans. */
import type { FramePlan } from "../generated/api";

export interface Change { what: string; name: string; how: "added" | "removed" | "changed"; detail: string; }

export function changesBetween(before: FramePlan, after: FramePlan): Change[] {
  const reasons = (effects: readonly { name: string; why: string }[]) => Object.fromEntries(effects.map(({ name, why }) => [name, why]));
  const programs = (plan: FramePlan) =>
    Object.fromEntries(Object.entries(plan.programs).map(([name, { vertex, fragment }]) => [name, `${vertex.sha256} ${fragment.sha256}`]));
  const passes = (plan: FramePlan) => {
    const counts: Record<string, string[]> = {};
    for (const { name, ...rest } of plan.passes) (counts[name] ??= []).push(JSON.stringify(rest));
    return Object.fromEntries(Object.entries(counts).map(([name, all]) => [name, all.join()]));
  };
  return [
    ...compared("effect", reasons(before.effects), reasons(after.effects), String),
    ...compared("skipped effect", reasons(before.skipped), reasons(after.skipped), String),
    ...compared("pass", passes(before), passes(after), () => ""),
    ...compared("program", programs(before), programs(after), () => "GLSL"),
    ...compared("target", before.targets, after.targets, (target) => `${target.format}, ${sizeText(target.size)}`),
    ...compared("texture", before.textures, after.textures, (texture) => `${texture.format}, ${texture.width} × ${texture.height}`),
    ...compared("uniform", before.uniforms, after.uniforms, (uniform) => constants(uniform)),
    ...compared("samples per pixel", { samples: before.samples }, { samples: after.samples }, String),
  ];
}

function compared<T>(what: string, before: Record<string, T>, after: Record<string, T>, text: (value: T) => string): Change[] {
  const names = [...new Set([...Object.keys(before), ...Object.keys(after)])];
  return names.flatMap((name): Change[] => {
    const [old, now] = [before[name], after[name]];
    if (old === undefined && now !== undefined) return [{ what, name, how: "added", detail: text(now) }];
    if (now === undefined && old !== undefined) return [{ what, name, how: "removed", detail: text(old) }];
    if (old === undefined || now === undefined || JSON.stringify(old) === JSON.stringify(now)) return [];
    const [from, to] = [text(old), text(now)];
    return [{ what, name, how: "changed", detail: from === to ? to : `${from} → ${to}` }];
  });
}

function sizeText(size: FramePlan["targets"][string]["size"]): string {
  if (size.rule === "fixed") return `${size.width} × ${size.height}`;
  const { scale, part, narrow, odd } = size;
  return `picture × ${scale} / ${part}${narrow === 1 ? "" : `, width / ${narrow}`}${odd ? ", made odd" : ""}`;
}

/** The numbers of a uniform of constants; how many rules any other has. */
function constants({ rules }: FramePlan["uniforms"][string]): string {
  const values = rules.flatMap((rule) => (rule.rule === "constant" ? rule.value : []));
  if (values.length === 0) return `rules: ${[...new Set(rules.map(({ rule }) => rule))].join(", ")}`;
  const shown = values.slice(0, 4).map((value) => Number(value.toPrecision(4)));
  return shown.join(", ") + (values.length > 4 ? ", …" : "");
}
