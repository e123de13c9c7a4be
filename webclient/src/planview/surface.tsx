/** "Frame plan": what runs for the current scene, why, what was left out, the GLSL, and what is different from the preset's plan. */
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { DrawTimer, timerExtension } from "../accuracy/measure/drawtimer";
import { median } from "../accuracy/measure/measured";
import type { FramePlan, Pass } from "../generated/api";
import type { Gpu } from "../gl/gpu";
import { makeScreen } from "../gl/resources";
import { labelOf } from "../panel/model";
import type { Executor, Frame } from "../plan/executor";
import type { PageContext } from "../surfaces/context";
import { Head, Pills, TaskButton, useChanges } from "../surfaces/parts";
import { Passes } from "./passes";
import { Source, type Stage } from "./source";

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

const VIEWS = ["Passes", "Effects", "GLSL", "Changes"] as const;
type View = (typeof VIEWS)[number];
const PRESET_TIER = "standard"; // Quality of the preset's own plan
/** Frames that are measured; the median of each pass counts. The first ones compile and allocate. */
const FRAMES = 7;
const WARM_UP = 2;

const NOTES =
  "notes *:border-b *:border-line *:py-2 *:text-soft [&_b]:font-semibold [&_b]:text-ink [&_small]:block [&_small]:text-small [&_small]:wrap-anywhere";

const counted = (count: number, one: string, many = `${one}s`) => `${count} ${count === 1 ? one : many}`;

function Effects({ plan }: { plan: FramePlan }) {
  return (
    <>
      <h3>Active: {plan.effects.length}</h3>
      <ul class={NOTES}>
        {plan.effects.map(({ name, why, files }) => (
          <li key={name}><b>{labelOf(name)}</b> {why}{files.length > 0 && <small>{files.join(", ")}</small>}</li>
        ))}
      </ul>
      <h3>Skipped: {plan.skipped.length}</h3>
      <ul class={`skipped ${NOTES}`}>
        {plan.skipped.map(({ name, why, bound }) => (
          <li key={name}>
            <b>{labelOf(name)}</b> {why}
            {typeof bound === "number" && <small>A pixel changes by at most {(255 * bound).toPrecision(2)} of 255.</small>}
          </li>
        ))}
      </ul>
    </>
  );
}

function Changes({ context, plan }: { context: PageContext; plan: FramePlan }) {
  const changes = useSignal<Change[] | null>(null);
  const { name, title } = context.store.now.preset;
  useEffect(() => {
    let current = true;
    context.api.presetPlan(name, PRESET_TIER).then((own) => {
      if (current) changes.value = changesBetween(own, plan);
    }, context.options.failed);
    return () => {
      current = false;
    };
  }, [name, plan]);
  if (changes.value === null) return <p>Loading the preset's plan…</p>;
  if (changes.value.length === 0) return <p>This plan is that of “{title}” at quality {PRESET_TIER}.</p>;
  return (
    <>
      <p>{changes.value.length} differences from the plan of “{title}” at quality {PRESET_TIER}.</p>
      <ul class={`plan-changes ${NOTES}`}>
        {changes.value.map(({ what, name: changed, how, detail }) => (
          <li key={`${what} ${changed}`} class={how}><b>{what} {changed}</b>{" "}{how}{detail && <small>{detail}</small>}</li>
        ))}
      </ul>
    </>
  );
}

/** Why there are no times; null if there can be. */
function reasonForNoTimes(gpu: Gpu | null): string | null {
  if (gpu === null) return "Not measured: the server draws the frames.";
  if (gpu.capabilities.software) return `Not measured: ${gpu.capabilities.renderer} draws on the CPU, where timer queries are wrong.`;
  if (timerExtension(gpu.gl, gpu.capabilities)) return null;
  return "Not measured: this browser gives no access to GPU timers (EXT_disjoint_timer_query_webgl2).";
}

/** Milliseconds by pass; throws if the queries fail. Passes that this camera does not need have none. */
async function passTimes(gpu: Gpu, executor: Executor, view: Pick<Frame, "time" | "camera" | "width" | "height">): Promise<Map<Pass, number>> {
  const samples = new Map<Pass, number[]>();
  const screen = makeScreen(gpu.gl, view.width, view.height);
  try {
    const timer = new DrawTimer(gpu, screen.framebuffer);
    const frame = { ...view, screen: screen.framebuffer, scissor: null, scene: null };
    for (let number = 0; number < FRAMES; number++) {
      const times = await timer.passes(executor, frame);
      if (number < WARM_UP) continue;
      for (const [pass, time] of times) samples.set(pass, [...(samples.get(pass) ?? []), time]);
    }
  } finally {
    screen.dispose();
  }
  return new Map([...samples].map(([pass, times]) => [pass, median(times)]));
}

function Timing({ context, measure, measured }: { context: PageContext; measure: () => Promise<void>; measured: boolean }) {
  const reason = reasonForNoTimes(context.display.viewport?.gpu ?? null);
  if (reason !== null) return <p>Time of each pass: {reason}</p>;
  return (
    <div class="pills">
      <TaskButton run={measure} failed={context.options.failed}>
        {measured ? "Measure again" : "Measure the time of each pass"}
      </TaskButton>
    </div>
  );
}

function Plan({ context }: { context: PageContext }) {
  const plan = useSignal(context.plan);
  const view = useSignal<View>("Passes");
  const source = useSignal<{ program: string; stage: Stage }>({ program: "surface", stage: "fragment" });
  const times = useSignal<ReadonlyMap<Pass, number> | null>(null);
  useChanges(context, () => {
    if (plan.value === context.plan) return;
    plan.value = context.plan;
    times.value = null;
  });
  const current = plan.value;
  if (current === null) return <p>Loading plan…</p>;
  // Before the first frame the canvas has no size of its own yet.
  const { width, height } = context.view();
  const measure = async () => {
    const executor = context.executor;
    const viewport = context.display.viewport;
    if (executor === null || viewport === null) return;
    const timed = { time: context.clock.time, camera: context.controls.camera, width, height };
    times.value = await viewport.runExclusive(() => passTimes(viewport.gpu, executor, timed));
    viewport.dirty = true;
  };
  const choose = (program: string, stage: Stage = "fragment") => {
    source.value = { program, stage };
    view.value = "GLSL";
  };
  const program = source.value.program in current.programs ? source.value.program : (Object.keys(current.programs)[0] ?? "");
  const { length } = current.passes;
  return (
    <>
      <p>
        {counted(length, "pass", "passes")}, {counted(Object.keys(current.programs).length, "program")},{" "}
        {counted(Object.keys(current.textures).length, "texture")}, {counted(current.samples, "sample")} per pixel, picture of {width} × {height}.
      </p>
      <div class="pills" role="group" aria-label="View">
        <Pills names={VIEWS} chosen={view.value} choose={(name) => (view.value = name)} />
      </div>
      {view.value === "Passes" && (
        <>
          <Timing context={context} measure={measure} measured={times.value !== null} />
          <Passes plan={current} width={width} height={height} times={times.value} choose={choose} />
        </>
      )}
      {view.value === "Effects" && <Effects plan={current} />}
      {view.value === "GLSL" && (
        <Source plan={current} executor={context.executor} gl={context.display.viewport?.gl ?? null} program={program} stage={source.value.stage} choose={choose} />
      )}
      {view.value === "Changes" && <Changes context={context} plan={current} />}
    </>
  );
}

export function Surface({ context }: { context: PageContext }) {
  return <><Head title="Frame plan" close={context.options.close} /><Plan context={context} /></>;
}
