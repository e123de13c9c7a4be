/** Binds a program's active uniforms and samplers to what the plan gives them. */
import type { FramePlan, Pass, Uniform } from "../generated/api";
import type { ActiveUniform, Program } from "../gl/program";
import type { Target } from "../gl/target";
import type { Json } from "../scene/json";
import { fill, type FrameState, isLive, liveRule, type Rule } from "./rules";

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
  /** A texture, or the name of a target. */
  source: WebGLTexture | string;
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
