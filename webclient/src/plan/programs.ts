/** A plan's programs, which plans share on the GPU: compiled, linked, their active uniforms and samplers bound to what the plan gives them. */
import type { FramePlan, Pass, Uniform } from "../generated/api";
import type { Gpu, Lease } from "../gl/gpu";
import { type ActiveUniform, finishProgram, type Program, startProgram, whenReady } from "../gl/program";
import type { Target } from "../gl/resources";
import type { Json } from "../scene/json";
import { fill, type FrameState, isLive, liveRule, type Rule } from "./rules";
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

/** By a uniform's type: that of the driver, its components, and the call that uploads it, but for a matrix. */
const TYPES = {
  float: ["FLOAT", 1, "uniform1fv"],
  vec2: ["FLOAT_VEC2", 2, "uniform2fv"],
  vec3: ["FLOAT_VEC3", 3, "uniform3fv"],
  vec4: ["FLOAT_VEC4", 4, "uniform4fv"],
  mat4: ["FLOAT_MAT4", 16, null],
} as const;
const SAMPLERS = ["SAMPLER_2D", "SAMPLER_2D_ARRAY", "UNSIGNED_INT_SAMPLER_2D", "INT_SAMPLER_2D"] as const;

interface BoundUniform {
  active: ActiveUniform;
  uniform: Uniform;
  /** Its rules with the live fields of the scene that was drawn last; null if none of them is live. */
  live: { scene: Json | null; rules: readonly Rule[] } | null;
  values: Float32Array;
}

interface BoundSampler {
  location: WebGLUniformLocation;
  unit: number;
  target: "TEXTURE_2D" | "TEXTURE_2D_ARRAY";
  source: WebGLTexture | string; // A texture, or the name of a target
}

export interface Bindings { uniforms: BoundUniform[]; samplers: BoundSampler[]; }

export function bindInputs(
  gl: WebGL2RenderingContext,
  plan: FramePlan,
  pass: Pass,
  program: Program,
  textures: ReadonlyMap<string, WebGLTexture>,
): Bindings {
  const uniforms: BoundUniform[] = [];
  const samplers: BoundSampler[] = [];
  for (const [name, active] of program.uniforms) {
    if (SAMPLERS.some((sampler) => gl[sampler] === active.type)) {
      const input = pass.inputs?.[name];
      const source = input && ("texture" in input ? textures.get(input.texture) : input.target);
      if (source === undefined) throw new Error(`Pass ${pass.name}: the plan has no input for sampler ${name}.`);
      const target = active.type === gl.SAMPLER_2D_ARRAY ? "TEXTURE_2D_ARRAY" : "TEXTURE_2D";
      samplers.push({ location: active.location, unit: samplers.length, target, source });
      continue;
    }
    const uniform = pass.uniforms?.[name] ?? plan.uniforms[name];
    if (uniform === undefined) throw new Error(`Pass ${pass.name}: the plan has no uniform ${name}.`);
    const [type, components] = TYPES[uniform.type];
    if (gl[type] !== active.type) throw new Error(`Pass ${pass.name}: uniform ${name} is not a ${uniform.type} in the program.`);
    const live = uniform.rules.some(isLive) ? { scene: null, rules: uniform.rules } : null;
    uniforms.push({ active, uniform, live, values: new Float32Array(components * uniform.count) });
  }
  return { uniforms, samplers };
}

export function uploadUniforms(gl: WebGL2RenderingContext, { uniforms }: Bindings, state: FrameState, scene: Json | null): void {
  for (const { active, uniform, live, values } of uniforms) {
    if (live !== null && live.scene !== scene) {
      // Pointers into the scene are followed once a change, not in every frame.
      live.scene = scene;
      live.rules = uniform.rules.map((rule) => liveRule(rule, scene));
    }
    fill(live?.rules ?? uniform.rules, state, values);
    const [, , upload] = TYPES[uniform.type];
    if (upload === null) gl.uniformMatrix4fv(active.location, false, values);
    else gl[upload](active.location, values);
  }
}

export function bindSamplers(gl: WebGL2RenderingContext, { samplers }: Bindings, find: (target: string) => Target | undefined): void {
  for (const { location, unit, target, source } of samplers) {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl[target], typeof source === "string" ? (find(source)?.texture ?? null) : source);
    gl.uniform1i(location, unit);
  }
}

/** A target still bound for reading would be a feedback loop in a later pass that draws into it. */
export function unbindSamplers(gl: WebGL2RenderingContext, { samplers }: Bindings): void {
  for (const { unit, target } of samplers) {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl[target], null);
  }
}
