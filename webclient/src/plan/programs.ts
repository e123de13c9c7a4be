/** Compiles and links a plan's programs; plans share them on the GPU. */
import type { FramePlan } from "../generated/api";
import type { Gpu, Lease } from "../gl/gpu";
import { finishProgram, type Program, startProgram, whenReady } from "../gl/program";
import { appliesTo, type Eye } from "./view";

/** Names of the programs that draw for an eye there. */
export function programNames(plan: FramePlan, eye: Eye): string[] {
  return [...new Set(plan.passes.filter((pass) => appliesTo(pass, eye)).map((pass) => pass.program))];
}

/** Compiles and links without blocking the page: all at once where the driver says when it is done, else one by one, the smallest first. */
export async function loadPrograms(gpu: Gpu, plan: FramePlan, names: readonly string[]): Promise<Map<string, Lease<Program>>> {
  const programs = new Map<string, Lease<Program>>();
  const start = (name: string): Lease<Program> => {
    const source = sourceOf(plan, name);
    const lease = gpu.programs.acquire(`${source.vertex.sha256} ${source.fragment.sha256}`, () => startProgram(gpu.gl, source));
    programs.set(name, lease);
    return lease;
  };
  const finish = async (name: string, lease: Lease<Program>): Promise<void> =>
    discardOnError(lease, async () => {
      await whenReady(gpu.gl, lease.value, gpu.capabilities);
      finishProgram(gpu.gl, lease.value, name);
    });
  const size = (name: string) => sourceOf(plan, name).fragment.text.length;
  try {
    if (gpu.capabilities.extensions.has("KHR_parallel_shader_compile")) {
      names.forEach(start);
      for (const [name, lease] of programs) await finish(name, lease);
    } else {
      for (const name of [...names].sort((a, b) => size(a) - size(b))) await finish(name, start(name));
    }
    return programs;
  } catch (error) {
    releaseAll(programs);
    throw error;
  }
}

export function releaseAll(leases: ReadonlyMap<string, Lease<unknown>>): void {
  for (const lease of leases.values()) lease.release();
}

function sourceOf(plan: FramePlan, name: string): FramePlan["programs"][string] {
  const source = plan.programs[name];
  if (source === undefined) throw new Error(`The plan has no program ${name}.`);
  return source;
}

/** Compiles a plan's programs only; returns the errors. */
export async function compileErrors(gpu: Gpu, plan: FramePlan): Promise<string[]> {
  const errors: string[] = [];
  for (const name of Object.keys(plan.programs)) {
    await loadPrograms(gpu, plan, [name]).then(releaseAll, (error: unknown) => errors.push(String(error)));
  }
  return errors;
}

/** Removes a resource that failed to load from its pool, so that the next plan loads it again. */
export async function discardOnError<T>(lease: Lease<unknown>, load: () => Promise<T>): Promise<T> {
  try {
    return await load();
  } catch (error) {
    lease.discard();
    throw error;
  }
}
