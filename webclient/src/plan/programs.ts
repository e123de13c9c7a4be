/** Compiles and links a plan's programs; plans share them on the GPU. */
import type { FramePlan } from "../generated/api";
import type { Gpu } from "../gl/gpu";
import type { Lease } from "../gl/pool";
import { finishProgram, type Program, startProgram, whenReady } from "../gl/program";
import { appliesTo, type Eye } from "./view";

/** Names of the programs that draw for an eye there. */
export function programNames(plan: FramePlan, eye: Eye): string[] {
  return [...new Set(plan.passes.filter((pass) => appliesTo(pass, eye)).map((pass) => pass.program))];
}

/** Starts all compilations before any result is asked for, so that the driver may run them in parallel. */
export function startPrograms(gpu: Gpu, plan: FramePlan, names: readonly string[]): Map<string, Lease<Program>> {
  return new Map(
    names.map((name) => {
      const source = plan.programs[name];
      if (source === undefined) throw new Error(`The plan has no program ${name}.`);
      const key = `${source.vertex.sha256} ${source.fragment.sha256}`;
      return [name, gpu.programs.acquire(key, () => startProgram(gpu.gl, source))];
    }),
  );
}

export async function finishPrograms(gpu: Gpu, programs: ReadonlyMap<string, Lease<Program>>): Promise<void> {
  for (const [name, lease] of programs) {
    await discardOnError(lease, async () => {
      await whenReady(gpu.gl, lease.value, gpu.capabilities);
      finishProgram(gpu.gl, lease.value, name);
    });
  }
}

/** Compiles a plan's programs only; returns the errors. */
export async function compileErrors(gpu: Gpu, plan: FramePlan): Promise<string[]> {
  const errors: string[] = [];
  for (const program of startPrograms(gpu, plan, Object.keys(plan.programs))) {
    await finishPrograms(gpu, new Map([program])).catch((error: unknown) => errors.push(String(error)));
    program[1].release();
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
