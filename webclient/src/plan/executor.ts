/** Runs a frame plan in WebGL2: the plan says everything, and nothing here knows what it draws. */
import type { FramePlan, Pass, Texture as TextureSpec, Uniform } from "../generated/api";
import type { CameraState } from "../camera/state";
import { requireFor } from "../gl/capabilities";
import type { Gpu } from "../gl/gpu";
import { makeMesh, type Mesh, meshKey } from "../gl/mesh";
import type { Lease } from "../gl/pool";
import { type ActiveUniform, finishProgram, type Program, startProgram, whenReady } from "../gl/program";
import { deleteTarget, makeTarget, type StillTarget, type Target, targetSize } from "../gl/target";
import { makeTexture, textureKey } from "../gl/texture";
import type { Json } from "../scene/json";
import { liveRule } from "./live";
import { fill, type FrameState } from "./rules";
import { drawnPasses, type Eye, eyeOf, passesInto, serves, targetsRead } from "./view";

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
  /** Whether any of its numbers follow the scene. */
  live: boolean;
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
  mesh: Mesh;
  uniforms: BoundUniform[];
  samplers: BoundSampler[];
}

/** A share in a kept target. */
interface Kept {
  key: string;
  lease: Lease<StillTarget>;
}

export class Executor {
  /** Settles when what this camera does not need yet is there too. */
  whole: Promise<void> = Promise.resolve();
  private readonly passes = new Map<number, BoundPass>();
  /** Those that are drawn in every frame. */
  private readonly targets = new Map<string, Target>();
  private readonly kept = new Map<string, Kept>();
  /** Positions of the passes that are drawn once. */
  private readonly setup: readonly number[];
  private disposed = false;
  /** Called once there is a first frame, or there will be none. */
  private begun: () => void = () => undefined;
  readonly programs = new Map<string, Program>();

  private constructor(
    private readonly gpu: Gpu,
    readonly plan: FramePlan,
    private readonly textures: ReadonlyMap<string, WebGLTexture>,
    private readonly leases: Lease<unknown>[],
  ) {
    this.setup = [...plan.passes.keys()].filter((index) => plan.passes[index]?.when === "setup");
  }

  /** Compiles and loads what the plan needs for an eye there, without stopping the page; `rest`: then what others need. */
  static async load(gpu: Gpu, plan: FramePlan, bytes: LoadBytes, camera: CameraState, rest: boolean): Promise<Executor> {
    requireFor(plan, gpu.capabilities);
    const leases: Lease<unknown>[] = [];
    try {
      const programs = start(gpu, plan, namesFor(plan, eyeOf(plan, camera)));
      leases.push(...programs.values());
      const loading = Object.entries(plan.textures).map(async ([name, spec]) => {
        const lease = gpu.textures.acquire(textureKey(spec), () =>
          bytes(spec).then((data) => makeTexture(gpu.gl, spec, data)),
        );
        leases.push(lease);
        return [name, await discardOnError(lease, () => lease.value)] as const;
      });
      for (const [name, lease] of programs) {
        await discardOnError(lease, () => finish(gpu, name, lease.value));
      }
      const executor = new Executor(gpu, plan, new Map(await Promise.all(loading)), leases);
      executor.bind(programs);
      // Drivers take programs and frames in the order they come in: the first frame does not wait for what it does not show.
      if (rest) {
        const begun = new Promise<void>((resolve) => (executor.begun = resolve));
        executor.whole = begun.then(() => (executor.disposed ? undefined : executor.loadRest()));
      }
      return executor;
    } catch (error) {
      for (const lease of leases) lease.release();
      throw error;
    }
  }

  /** Compiles what the first camera had no need of. */
  private async loadRest(): Promise<void> {
    const missing = Object.keys(this.plan.programs).filter((name) => !this.programs.has(name));
    const programs = start(this.gpu, this.plan, missing);
    try {
      for (const [name, lease] of programs) await discardOnError(lease, () => finish(this.gpu, name, lease.value));
      if (!this.disposed) this.bind(programs);
    } finally {
      if (this.disposed) for (const lease of programs.values()) lease.release();
      else this.leases.push(...programs.values());
    }
  }

  /** Binds the passes whose programs have come. */
  private bind(programs: ReadonlyMap<string, Lease<Program>>): void {
    const { gpu, plan, textures } = this;
    for (const [name, { value }] of programs) this.programs.set(name, value);
    plan.passes.forEach((pass, index) => {
      const program = programs.get(pass.program)?.value;
      if (program === undefined) return;
      const mesh = gpu.meshes.acquire(meshKey(pass.mesh), () => makeMesh(gpu.gl, pass.mesh));
      this.leases.push(mesh);
      this.passes.set(index, { pass, index, program, mesh: mesh.value, ...bindInputs(gpu.gl, plan, pass, program, textures) });
    });
  }

  /** Whether everything is there that an eye there needs. */
  has(eye: Eye): boolean {
    return namesFor(this.plan, eye).every((name) => this.programs.has(name));
  }

  /** Draws one frame. `around`: runs each pass, for who wants to time it. */
  draw(frame: Frame, around = (_: Pass, draw: () => void) => draw()): void {
    this.resize(frame.width, frame.height);
    // What draws for a low eye draws for any; the other way about it is a moment's stopgap.
    const wanted = eyeOf(this.plan, frame.camera);
    const eye = this.has(wanted) ? wanted : wanted === "over" ? "under" : "over";
    const drawn = [...drawnPasses(this.plan, eye, frame.camera, frame.width, frame.height)].flatMap(([index, shows]) => {
      const bound = this.passes.get(index);
      return bound === undefined || bound.pass.when === "setup" ? [] : [{ bound, shows }];
    });
    this.setUp(new Set(drawn.flatMap(({ bound, shows }) => (shows ? targetsRead(bound.pass) : []))), frame);
    for (const { bound, shows } of drawn) {
      if (shows) around(bound.pass, () => this.drawPass(bound, frame, (name) => this.target(name)));
      else this.clear(bound.pass);
    }
    this.begun();
  }

  /** A target as the latest frame left it. */
  target(name: string): Target | undefined {
    return this.targets.get(name) ?? this.kept.get(name)?.lease.value;
  }

  /** Gives the targets' memory back until the next frame. */
  rest(): void {
    for (const target of this.targets.values()) deleteTarget(this.gpu.gl, target);
    this.targets.clear();
    for (const { lease } of this.kept.values()) lease.release();
    this.kept.clear();
  }

  dispose(): void {
    this.disposed = true;
    this.begun();
    this.rest();
    for (const lease of this.leases) lease.release();
  }

  private resize(width: number, height: number): void {
    const { gl } = this.gpu;
    const drawnOnce = new Set(this.setup.map((index) => this.plan.passes[index]?.target));
    for (const [name, spec] of Object.entries(this.plan.targets)) {
      if (drawnOnce.has(name)) continue;
      const [w, h] = targetSize(spec, width, height);
      const target = this.targets.get(name);
      if (target?.width === w && target.height === h) continue;
      if (target) deleteTarget(gl, target);
      this.targets.set(name, makeTarget(gl, spec, w, h));
    }
  }

  /** Takes hold of the kept targets that are read, and draws those that no plan has drawn with these numbers. */
  private setUp(read: ReadonlySet<string>, frame: Frame): void {
    const { gl, stills } = this.gpu;
    for (const [name, digest] of Object.entries(this.plan.kept)) {
      if (!read.has(name)) continue;
      const key = this.stillKey(name, digest, frame.scene);
      const held = this.kept.get(name);
      if (held?.key === key) continue;
      const make = () => ({ ...this.makeFixed(name), drawn: false });
      this.kept.set(name, { key, lease: stills.acquire(key, make) });
      held?.lease.release();
    }
    const fresh = new Map([...this.kept].map(([name, { lease }]) => [name, lease.value] as const).filter(([, { drawn }]) => !drawn));
    if (fresh.size === 0) return;
    const steps = passesInto(this.plan, this.setup, fresh.keys());
    const onTheWay = new Map<string, Target>();
    try {
      for (const index of steps) {
        const bound = required(this.passes.get(index), `program for pass ${index} yet`);
        const { target } = bound.pass;
        if (!fresh.has(target) && !onTheWay.has(target)) onTheWay.set(target, this.makeFixed(target));
        this.drawPass(bound, frame, (name) => fresh.get(name) ?? onTheWay.get(name));
      }
      for (const still of fresh.values()) still.drawn = true;
    } finally {
      for (const target of onTheWay.values()) deleteTarget(gl, target);
    }
  }

  /** What a kept target's pixels hang on: what the plan says, and the live numbers as the scene has them. */
  private stillKey(name: string, digest: string, scene: Json | null): string {
    const live = passesInto(this.plan, this.setup, [name]).flatMap((index) =>
      (this.passes.get(index)?.uniforms ?? []).filter(({ live }) => live).flatMap(({ uniform }) => uniform.rules),
    );
    return live.length === 0 ? digest : `${digest} ${JSON.stringify(live.map((rule) => liveRule(rule, scene)))}`;
  }

  private makeFixed(name: string): Target {
    const spec = required(this.plan.targets[name], `target ${name}`);
    return makeTarget(this.gpu.gl, spec, ...targetSize(spec, 0, 0));
  }

  /** Empties the target of a pass that has nothing to draw into it. */
  private clear(pass: Pass): void {
    const { gl } = this.gpu;
    gl.bindFramebuffer(gl.FRAMEBUFFER, required(this.targets.get(pass.target), `target ${pass.target}`).framebuffer);
    gl.disable(gl.SCISSOR_TEST);
    this.empty();
  }

  private empty(): void {
    const { gl } = this.gpu;
    gl.depthMask(true);
    gl.clearColor(0, 0, 0, 0);
    gl.clearDepth(1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }

  private drawPass(
    { pass, index, program, mesh, uniforms, samplers }: BoundPass,
    frame: Frame,
    find: (name: string) => Target | undefined,
  ): void {
    const { gl } = this.gpu;
    const onScreen = pass.target === "screen";
    const target = onScreen
      ? { framebuffer: frame.screen, texture: null, mipmapped: false, width: frame.width, height: frame.height }
      : required(find(pass.target), `target ${pass.target}`);
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
    const { blend } = pass.state;
    if (blend === "none" && !this.gpu.capabilities.alwaysBlends) {
      gl.disable(gl.BLEND);
    } else {
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, blend === "none" ? gl.ZERO : blend === "add" ? gl.ONE : gl.ONE_MINUS_SRC_ALPHA);
    }
    gl.disable(gl.CULL_FACE);
    gl.depthMask(true);
    gl.depthFunc(gl.LESS);
    if (pass.state.depth) gl.enable(gl.DEPTH_TEST);
    else gl.disable(gl.DEPTH_TEST);
    if (pass.state.clear) this.empty();
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
    for (const { active, uniform, live, values } of uniforms) {
      const rules = live ? uniform.rules.map((rule) => liveRule(rule, frame.scene)) : uniform.rules;
      fill(rules, state, values);
      upload(gl, active, values);
    }
    for (const { location, unit, reads } of samplers) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      const texture = typeof reads === "string" ? (find(reads)?.texture ?? null) : reads;
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform1i(location, unit);
    }
    mesh.draw();
    // A target left bound for reading would make a later pass into it a feedback loop.
    for (const { unit } of samplers) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, null);
    }
    if (target.mipmapped) {
      gl.activeTexture(gl.TEXTURE0);
      gl.bindTexture(gl.TEXTURE_2D, target.texture);
      gl.generateMipmap(gl.TEXTURE_2D);
      gl.bindTexture(gl.TEXTURE_2D, null);
    }
  }
}

/** Compiles a plan's programs only, and tells what is wrong with them. */
export async function compile(gpu: Gpu, plan: FramePlan): Promise<string[]> {
  const errors: string[] = [];
  for (const [name, lease] of start(gpu, plan, Object.keys(plan.programs))) {
    await discardOnError(lease, () => finish(gpu, name, lease.value)).catch((error: unknown) => {
      errors.push(String(error));
    });
    lease.release();
  }
  return errors;
}

/** The programs that an eye there needs. */
function namesFor(plan: FramePlan, eye: Eye): string[] {
  return [...new Set(plan.passes.filter((pass) => serves(pass, eye)).map((pass) => pass.program))];
}

/** Compilation of every one of these programs starts before the driver is asked about any. */
function start(gpu: Gpu, plan: FramePlan, names: readonly string[]): Map<string, Lease<Program>> {
  return new Map(
    names.map((name) => {
      const source = required(plan.programs[name], `program ${name}`);
      const key = `${source.vertex.sha256} ${source.fragment.sha256}`;
      return [name, gpu.programs.acquire(key, () => startProgram(gpu.gl, source))];
    }),
  );
}

async function finish(gpu: Gpu, name: string, program: Program): Promise<void> {
  await whenReady(gpu.gl, program, gpu.capabilities);
  finishProgram(gpu.gl, program, name);
}

/** What failed to load must not be handed to the next plan as if it had loaded. */
async function discardOnError<T>(lease: Lease<unknown>, load: () => Promise<T>): Promise<T> {
  try {
    return await load();
  } catch (error) {
    lease.discard();
    throw error;
  }
}

/** Matches what the compiler kept of a program with what the plan gives it. */
function bindInputs(
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
      const input = required(pass.inputs?.[name], `input ${name} in pass ${pass.name}`);
      const reads = "texture" in input ? textures.get(input.texture) : input.target;
      if (reads === undefined) throw new Error(`pass ${pass.name}: sampler ${name} reads a texture the plan lacks`);
      samplers.push({ location: active.location, unit: samplers.length, reads });
      continue;
    }
    const uniform = pass.uniforms?.[name] ?? plan.uniforms[name];
    if (uniform === undefined) throw new Error(`pass ${pass.name}: the plan has no uniform ${name}`);
    const type = { float: gl.FLOAT, vec2: gl.FLOAT_VEC2, vec3: gl.FLOAT_VEC3, vec4: gl.FLOAT_VEC4, mat4: gl.FLOAT_MAT4 }[
      uniform.type
    ];
    if (type !== active.type) throw new Error(`pass ${pass.name}: uniform ${name} is no ${uniform.type} in the program`);
    const components = { float: 1, vec2: 2, vec3: 3, vec4: 4, mat4: 16 }[uniform.type];
    const live = uniform.rules.some((rule) => rule.rule === "constant" && typeof rule.field === "string");
    uniforms.push({ active, uniform, live, values: new Float32Array(components * uniform.count) });
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

function required<T>(value: T | undefined, what: string): T {
  if (value === undefined) throw new Error(`the plan has no ${what}`);
  return value;
}
