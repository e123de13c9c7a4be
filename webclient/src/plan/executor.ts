/** Runs a frame plan in WebGL2: the plan says everything, and nothing here knows what it draws. */
import type { FramePlan, Pass, Target as TargetSpec, Texture as TextureSpec, Uniform } from "../generated/api";
import type { CameraState } from "../camera/state";
import { requireFor } from "../gl/capabilities";
import type { Gpu } from "../gl/gpu";
import { makeMesh, meshKey } from "../gl/mesh";
import { type ActiveUniform, finishProgram, isReady, type Program, startProgram } from "../gl/program";
import { deleteTarget, makeTarget, type Target, targetSize } from "../gl/target";
import { makeTexture, textureKey } from "../gl/texture";
import type { Json } from "../scene/json";
import { liveRule } from "./live";
import { fill, type FrameState } from "./rules";

/** Reads the bytes of a texture of the plan. */
export type LoadBytes = (spec: TextureSpec) => Promise<ArrayBuffer>;

/** A rectangle of the picture, pixels, from the bottom left. */
export interface Rectangle {
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface Frame {
  /** s */
  time: number;
  camera: CameraState;
  width: number;
  height: number;
  /** Where the picture goes: null is the canvas. */
  screen: WebGLFramebuffer | null;
  /** Only this part of the screen is written. */
  scissor: Rectangle | null;
  /** Scene whose live fields replace the plan's numbers. */
  scene: Json | null;
}

interface BoundUniform {
  active: ActiveUniform;
  uniform: Uniform;
  values: Float32Array;
}

interface BoundSampler {
  location: WebGLUniformLocation;
  unit: number;
  /** The texture, or the name of the target that is read. */
  reads: WebGLTexture | string;
}

interface BoundPass {
  pass: Pass;
  index: number;
  program: Program;
  mesh: string;
  uniforms: BoundUniform[];
  samplers: BoundSampler[];
}

const programKey = (plan: FramePlan, name: string) => {
  const { vertex, fragment } = named(plan.programs, name, "program");
  return `${vertex.sha256} ${fragment.sha256}`;
};

export class Executor {
  private readonly targets = new Map<string, Target>();
  /** Fixed targets whose setup passes have run since they were made. */
  private isSetUp = false;

  private constructor(
    private readonly gpu: Gpu,
    readonly plan: FramePlan,
    private readonly passes: readonly BoundPass[],
    private readonly held: readonly (() => void)[],
  ) {}

  /** Compiles and loads everything that the plan needs, without stopping the page. */
  static async load(gpu: Gpu, plan: FramePlan, bytes: LoadBytes): Promise<Executor> {
    requireFor(plan, gpu.capabilities);
    const held: (() => void)[] = [];
    try {
      // Compilation starts for all programs before the driver is asked about any.
      const programs = new Map(
        Object.entries(plan.programs).map(([name, source]) => {
          const key = programKey(plan, name);
          held.push(() => gpu.programs.release(key));
          return [name, gpu.programs.acquire(key, () => startProgram(gpu.gl, source))] as const;
        }),
      );
      const textures = new Map<string, WebGLTexture>();
      await Promise.all([
        finishAll(gpu, plan, programs),
        ...Object.entries(plan.textures).map(async ([name, spec]) => {
          const key = textureKey(spec);
          const texture = await gpu.textures.acquire(key, () =>
            bytes(spec).then((data) => makeTexture(gpu.gl, spec, data)),
          );
          held.push(() => gpu.textures.release(key));
          textures.set(name, texture);
        }),
      ]).catch((error: unknown) => {
        for (const spec of Object.values(plan.textures)) {
          // A failed download must not be kept as if it were the texture.
          if (!textures.size) gpu.textures.evict(textureKey(spec));
        }
        throw error;
      });
      const passes = plan.passes.map((pass, index) => {
        const mesh = meshKey(pass.mesh);
        gpu.meshes.acquire(mesh, () => makeMesh(gpu.gl, pass.mesh));
        held.push(() => gpu.meshes.release(mesh));
        const program = named(Object.fromEntries(programs), pass.program, "program");
        return { pass, index, program, mesh, ...bind(gpu.gl, plan, pass, program, textures) };
      });
      return new Executor(gpu, plan, passes, held);
    } catch (error) {
      for (const release of held) release();
      throw error;
    }
  }

  /** Draws one frame. */
  draw(frame: Frame): void {
    this.resize(frame.width, frame.height);
    for (const bound of this.passes) {
      if (bound.pass.when === "setup" && this.isSetUp) continue;
      this.drawPass(bound, frame);
    }
    this.isSetUp = true;
  }

  dispose(): void {
    for (const target of this.targets.values()) deleteTarget(this.gpu.gl, target);
    this.targets.clear();
    for (const release of this.held) release();
  }

  private resize(width: number, height: number): void {
    const { gl } = this.gpu;
    for (const [name, spec] of Object.entries(this.plan.targets)) {
      const [w, h] = targetSize(spec, width, height);
      const target = this.targets.get(name);
      if (target?.width === w && target.height === h) continue;
      if (target) deleteTarget(gl, target);
      this.targets.set(name, makeTarget(gl, spec satisfies TargetSpec, w, h));
      this.isSetUp = false;
    }
  }

  private drawPass({ pass, index, program, mesh, uniforms, samplers }: BoundPass, frame: Frame): void {
    const { gl } = this.gpu;
    const onScreen = pass.target === "screen";
    const target = onScreen
      ? { framebuffer: frame.screen, width: frame.width, height: frame.height }
      : named(Object.fromEntries(this.targets), pass.target, "target");
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    gl.viewport(0, 0, target.width, target.height);
    // Only the screen is cut: a later pass may read any pixel of a target.
    if (onScreen && frame.scissor) {
      const { x, y, width, height } = frame.scissor;
      gl.enable(gl.SCISSOR_TEST);
      gl.scissor(x, y, width, height);
    } else {
      gl.disable(gl.SCISSOR_TEST);
    }
    gl.disable(gl.BLEND);
    gl.disable(gl.CULL_FACE);
    gl.depthMask(true);
    gl.depthFunc(gl.LESS);
    if (pass.state.depth) gl.enable(gl.DEPTH_TEST);
    else gl.disable(gl.DEPTH_TEST);
    if (pass.state.clear) {
      gl.clearColor(0, 0, 0, 0);
      gl.clearDepth(1);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    }
    gl.useProgram(program.handle);
    const state: FrameState = {
      time: frame.time,
      camera: frame.camera,
      width: frame.width,
      height: frame.height,
      targetWidth: target.width,
      targetHeight: target.height,
      passIndex: index,
    };
    for (const { active, uniform, values } of uniforms) {
      fill({ ...uniform, rules: uniform.rules.map((rule) => liveRule(rule, frame.scene)) }, state, values);
      upload(gl, active, values);
    }
    for (const { location, unit, reads } of samplers) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      const texture = typeof reads === "string" ? (this.targets.get(reads)?.texture ?? null) : reads;
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform1i(location, unit);
    }
    this.gpu.meshes.peek(mesh)?.draw();
    // A target left bound for reading would make a later pass into it a feedback loop.
    for (const { unit } of samplers) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, null);
    }
  }
}

/** Compiles a plan's programs only, and tells what is wrong with them. */
export async function compile(gpu: Gpu, plan: FramePlan): Promise<string[]> {
  const errors: string[] = [];
  const started = Object.entries(plan.programs).map(([name, source]) => {
    const key = programKey(plan, name);
    return { name, key, program: gpu.programs.acquire(key, () => startProgram(gpu.gl, source)) };
  });
  for (const { name, key, program } of started) {
    await untilReady(gpu, program);
    try {
      finishProgram(gpu.gl, program, name);
      gpu.programs.release(key);
    } catch (error) {
      gpu.programs.evict(key);
      errors.push(String(error));
    }
  }
  return errors;
}

async function finishAll(gpu: Gpu, plan: FramePlan, programs: ReadonlyMap<string, Program>): Promise<void> {
  for (const [name, program] of programs) {
    await untilReady(gpu, program);
    try {
      finishProgram(gpu.gl, program, name);
    } catch (error) {
      gpu.programs.evict(programKey(plan, name));
      throw error;
    }
  }
}

async function untilReady(gpu: Gpu, program: Program): Promise<void> {
  while (!isReady(gpu.gl, program, gpu.capabilities) && !gpu.gl.isContextLost()) {
    await new Promise((resolve) => setTimeout(resolve, 4));
  }
}

/** Matches what the compiler kept of a program with what the plan gives it. */
function bind(
  gl: WebGL2RenderingContext,
  plan: FramePlan,
  pass: Pass,
  program: Program,
  textures: ReadonlyMap<string, WebGLTexture>,
): { uniforms: BoundUniform[]; samplers: BoundSampler[] } {
  const uniforms: BoundUniform[] = [];
  const samplers: BoundSampler[] = [];
  for (const [name, active] of program.uniforms) {
    if (isSampler(gl, active.type)) {
      const input = named(pass.inputs, name, `input of pass ${pass.name}:`);
      const reads = "texture" in input ? textures.get(input.texture) : input.target;
      if (reads === undefined) throw new Error(`pass ${pass.name}: sampler ${name} reads a texture the plan lacks`);
      samplers.push({ location: active.location, unit: samplers.length, reads });
      continue;
    }
    const uniform = pass.uniforms[name] ?? plan.uniforms[name];
    if (uniform === undefined) throw new Error(`pass ${pass.name}: the plan has no uniform ${name}`);
    const type = { float: gl.FLOAT, vec2: gl.FLOAT_VEC2, vec3: gl.FLOAT_VEC3, vec4: gl.FLOAT_VEC4, mat4: gl.FLOAT_MAT4 }[
      uniform.type
    ];
    if (type !== active.type) throw new Error(`pass ${pass.name}: uniform ${name} is no ${uniform.type} in the program`);
    const components = { float: 1, vec2: 2, vec3: 3, vec4: 4, mat4: 16 }[uniform.type];
    uniforms.push({ active, uniform, values: new Float32Array(components * uniform.count) });
  }
  return { uniforms, samplers };
}

function isSampler(gl: WebGL2RenderingContext, type: number): boolean {
  return type === gl.SAMPLER_2D || type === gl.UNSIGNED_INT_SAMPLER_2D || type === gl.INT_SAMPLER_2D;
}

function upload(gl: WebGL2RenderingContext, { location, type }: ActiveUniform, values: Float32Array): void {
  switch (type) {
    case gl.FLOAT:
      return gl.uniform1fv(location, values);
    case gl.FLOAT_VEC2:
      return gl.uniform2fv(location, values);
    case gl.FLOAT_VEC3:
      return gl.uniform3fv(location, values);
    case gl.FLOAT_VEC4:
      return gl.uniform4fv(location, values);
    default:
      return gl.uniformMatrix4fv(location, false, values);
  }
}

function named<T>(record: Readonly<Record<string, T>>, name: string, what: string): T {
  const value = record[name];
  if (value === undefined) throw new Error(`the plan has no ${what} ${name}`);
  return value;
}
