/** Binds a program's active uniforms and samplers to what the plan gives them. */
import type { FramePlan, Pass, Uniform } from "../generated/api";
import type { ActiveUniform, Program } from "../gl/program";
import type { Target } from "../gl/target";
import type { Json } from "../scene/json";
import { isLive, liveRule } from "./live";
import { fill, type FrameState, type Rule } from "./rules";

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
  /** A texture, or the name of a target. */
  source: WebGLTexture | string;
}

export interface Bindings {
  uniforms: BoundUniform[];
  samplers: BoundSampler[];
}

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
    if (isSampler(gl, active.type)) {
      const input = pass.inputs?.[name];
      const source = input && ("texture" in input ? textures.get(input.texture) : input.target);
      if (source === undefined) throw new Error(`Pass ${pass.name}: the plan has no input for sampler ${name}.`);
      samplers.push({ location: active.location, unit: samplers.length, source });
      continue;
    }
    const uniform = pass.uniforms?.[name] ?? plan.uniforms[name];
    if (uniform === undefined) throw new Error(`Pass ${pass.name}: the plan has no uniform ${name}.`);
    const types = { float: gl.FLOAT, vec2: gl.FLOAT_VEC2, vec3: gl.FLOAT_VEC3, vec4: gl.FLOAT_VEC4, mat4: gl.FLOAT_MAT4 };
    if (types[uniform.type] !== active.type) throw new Error(`Pass ${pass.name}: uniform ${name} is not a ${uniform.type} in the program.`);
    const components = { float: 1, vec2: 2, vec3: 3, vec4: 4, mat4: 16 }[uniform.type];
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
    upload(gl, active, values);
  }
}

export function bindSamplers(gl: WebGL2RenderingContext, { samplers }: Bindings, find: (target: string) => Target | undefined): void {
  for (const { location, unit, source } of samplers) {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, typeof source === "string" ? (find(source)?.texture ?? null) : source);
    gl.uniform1i(location, unit);
  }
}

/** A target still bound for reading would be a feedback loop in a later pass that draws into it. */
export function unbindSamplers(gl: WebGL2RenderingContext, { samplers }: Bindings): void {
  for (const { unit } of samplers) {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, null);
  }
}

function isSampler(gl: WebGL2RenderingContext, type: number): boolean {
  return type === gl.SAMPLER_2D || type === gl.UNSIGNED_INT_SAMPLER_2D || type === gl.INT_SAMPLER_2D;
}

function upload(gl: WebGL2RenderingContext, { location, type }: ActiveUniform, values: Float32Array): void {
  if (type === gl.FLOAT) gl.uniform1fv(location, values);
  else if (type === gl.FLOAT_VEC2) gl.uniform2fv(location, values);
  else if (type === gl.FLOAT_VEC3) gl.uniform3fv(location, values);
  else if (type === gl.FLOAT_VEC4) gl.uniform4fv(location, values);
  else gl.uniformMatrix4fv(location, false, values);
}
