/** Runs a frame plan in WebGL2. Everything specific to an effect is in the plan. */
import type { CameraState } from "../camera/state";
import type { FramePlan, Pass, Texture as TextureSpec } from "../generated/api";
import { requireSupport } from "../gl/capabilities";
import type { Gpu, Lease } from "../gl/gpu";
import { type CachedTarget, checkFormats, deleteTarget, makeMesh, makeScreen, makeTarget, makeTexture, type Mesh, meshKey, type Target, targetSize, textureKey } from "../gl/resources";
import { type Program, whenDone } from "../gl/program";
import type { Json } from "../scene/json";
import { type Bindings, bindInputs, bindSamplers, discardOnError, loadPrograms, programNames, releaseAll, unbindSamplers, uploadUniforms } from "./programs";
import { evaluate, isLive, isStepped, liveRule } from "./rules";
import { drawnPasses, type Eye, eyeOf, passesInto, targetsRead } from "./view";

/** Camera heights whose passes can stand in: between crest and trough, those of the other side draw nothing. */
const STAND_INS = { over: ["between"], between: ["over"], under: ["between"] } as const satisfies Record<Eye, readonly Eye[]>;

/** Pixels of the first frame of a plan, which nobody sees, and the longest time to wait for it, ms. */
const WARM_UP = { width: 64, height: 36, timeout: 10_000 };

export type LoadBytes = (spec: TextureSpec) => Promise<ArrayBuffer>;

/** Textures that are loaded with less than all digits. */
export interface RoughTextures { names: ReadonlySet<string>; bytes: LoadBytes; }

const ROUGH = "rough "; // What rough textures, and targets drawn from them, are kept by: no exact plan may find them

/** A part of the picture, pixels, origin at the bottom left. */
interface Rectangle { x: number; y: number; width: number; height: number; }

export interface Frame {
  time: number; // s
  camera: CameraState;
  width: number;
  height: number;
  screen: WebGLFramebuffer | null; // Framebuffer of the picture; null is the canvas
  scissor: Rectangle | null; // Limits what is written to the screen
  scene: Json | null; // Scene whose live fields replace the plan's constants
}

interface BoundPass { pass: Pass; program: Program; mesh: Mesh; bindings: Bindings; }

export class Executor {
  /** Settles when the programs that the first camera did not need are compiled. */
  complete: Promise<void> = Promise.resolve();
  readonly programs = new Map<string, Program>();
  private readonly passes = new Map<number, BoundPass>();
  private readonly targets = new Map<string, Target>(); // Targets that are drawn in every frame
  /** Targets that setup passes draw once. */
  private readonly cached = new Map<string, { key: string; lease: Lease<CachedTarget> }>();
  private readonly setupPasses: readonly number[];
  private disposed = false;
  /** Called after the first frame, and on disposal. */
  private firstFrameDrawn: () => void = () => undefined;

  private constructor(
    private readonly gpu: Gpu,
    readonly plan: FramePlan,
    private readonly textures: ReadonlyMap<string, WebGLTexture>,
    private readonly leases: Lease<unknown>[],
    /** Whether textures have less than all digits. */
    readonly rough: boolean,
  ) {
    this.setupPasses = [...plan.passes.keys()].filter((index) => plan.passes[index]?.when === "setup");
  }

  /** Loads what the plan needs for this camera without blocking the page; `loadRest`: then what other cameras need. */
  static async load(gpu: Gpu, plan: FramePlan, bytes: LoadBytes, camera: CameraState, loadRest: boolean, rough: RoughTextures | null = null): Promise<Executor> {
    requireSupport(plan, gpu.capabilities);
    checkFormats(gpu, Object.values(plan.targets));
    const leases: Lease<unknown>[] = [];
    // Between crest and trough the camera is most likely over the water: the first frame need not wait for what it sees under it.
    const eye = eyeOf(plan, camera);
    const compiling = loadPrograms(gpu, plan, programNames(plan, loadRest && eye === "between" ? "over" : eye));
    try {
      const loading = Object.entries(plan.textures).map(async ([name, spec]) => {
        const [mark, load] = rough?.names.has(name) ? [ROUGH, rough.bytes] : ["", bytes];
        const lease = gpu.textures.acquire(mark + textureKey(spec), () => load(spec).then((data) => makeTexture(gpu.gl, spec, data)));
        leases.push(lease);
        return [name, await discardOnError(lease, () => lease.value)] as const;
      });
      const [programs, ...textures] = await Promise.all([compiling, ...loading]);
      const executor = new Executor(gpu, plan, new Map(textures), leases, rough !== null);
      executor.bind(programs);
      leases.push(...programs.values());
      // Drivers process compilations and frames in order: the first frame must not wait for programs that it does not use.
      if (loadRest) {
        const firstFrame = new Promise<void>((resolve) => (executor.firstFrameDrawn = resolve));
        executor.complete = firstFrame.then(() => (executor.disposed ? undefined : executor.loadMissing()));
      }
      return executor;
    } catch (error) {
      for (const lease of leases) lease.release();
      void compiling.then(releaseAll, () => undefined);
      throw error;
    }
  }

  /**
   * Draws a first frame where nobody sees it and resolves when it is done: drivers compile when they first draw. `gently`: setup
   * passes are drawn one by one, and frames of the page come in between.
   */
  async warmUp(camera: CameraState, scene: Json, gently = false): Promise<void> {
    const { gl } = this.gpu;
    const { width, height, timeout } = WARM_UP;
    const screen = makeScreen(gl, width, height);
    const frame = { time: 0, camera, width, height, screen: screen.framebuffer, scissor: null, scene };
    try {
      const steps = this.drawCachedTargets(this.passesOf(frame), frame);
      while (gently && !steps.next().done) await whenDone(gl, timeout);
      if (this.disposed) return;
      this.draw(frame);
      await whenDone(gl, timeout);
    } finally {
      screen.dispose();
    }
  }

  private async loadMissing(): Promise<void> {
    const missing = Object.keys(this.plan.programs).filter((name) => !this.programs.has(name));
    const programs = await loadPrograms(this.gpu, this.plan, missing);
    if (this.disposed) {
      releaseAll(programs);
      return;
    }
    this.bind(programs);
    this.leases.push(...programs.values());
  }

  /** Binds the passes of these programs. */
  private bind(programs: ReadonlyMap<string, Lease<Program>>): void {
    const { gpu, plan, textures } = this;
    for (const [name, { value }] of programs) this.programs.set(name, value);
    plan.passes.forEach((pass, index) => {
      const program = programs.get(pass.program)?.value;
      if (program === undefined) return;
      const mesh = gpu.meshes.acquire(meshKey(pass.mesh), () => makeMesh(gpu.gl, pass.mesh));
      this.leases.push(mesh);
      this.passes.set(index, { pass, program, mesh: mesh.value, bindings: bindInputs(gpu.gl, plan, pass, program, textures) });
    });
  }

  isReadyFor(eye: Eye): boolean {
    return programNames(this.plan, eye).every((name) => this.programs.has(name));
  }

  /** Draws one frame; `around` wraps each pass, for timing. */
  draw(frame: Frame, around = (_: Pass, draw: () => void) => draw()): void {
    const drawn = this.passesOf(frame);
    // The last picture stays until the programs are compiled.
    if (drawn.length === 0) return;
    this.resizeTargets(frame.width, frame.height);
    const steps = this.drawCachedTargets(drawn, frame);
    while (!steps.next().done);
    for (const { bound, visible } of drawn) {
      if (visible) around(bound.pass, () => this.drawPass(bound, frame, (name) => this.target(name)));
      else this.clearTarget(bound.pass);
    }
    this.firstFrameDrawn();
  }

  /** The passes that make a frame; none while their programs are not compiled. */
  private passesOf({ camera, width, height }: Frame): { bound: BoundPass; visible: boolean }[] {
    const eye = eyeOf(this.plan, camera);
    const usableEye = [eye, ...STAND_INS[eye]].find((one) => this.isReadyFor(one));
    if (usableEye === undefined) return [];
    return [...drawnPasses(this.plan, usableEye, camera, width, height)].flatMap(([index, visible]) => {
      const bound = this.passes.get(index);
      return bound === undefined || bound.pass.when === "setup" ? [] : [{ bound, visible }];
    });
  }

  /** A target with the contents of the latest frame. */
  target(name: string): Target | undefined {
    return this.targets.get(name) ?? this.cached.get(name)?.lease.value;
  }

  /** Frees the targets' memory until the next frame. */
  releaseTargets(): void {
    for (const target of this.targets.values()) deleteTarget(this.gpu.gl, target);
    this.targets.clear();
    for (const { lease } of this.cached.values()) lease.release();
    this.cached.clear();
  }

  dispose(): void {
    this.disposed = true;
    this.firstFrameDrawn();
    this.releaseTargets();
    for (const lease of this.leases) lease.release();
  }

  private resizeTargets(pictureWidth: number, pictureHeight: number): void {
    const { gl } = this.gpu;
    const setupTargets = new Set(this.setupPasses.map((index) => this.plan.passes[index]?.target));
    for (const [name, spec] of Object.entries(this.plan.targets)) {
      if (setupTargets.has(name)) continue;
      const [width, height] = targetSize(spec, pictureWidth, pictureHeight);
      const target = this.targets.get(name);
      if (target?.width === width && target.height === height) continue;
      if (target) deleteTarget(gl, target);
      this.targets.set(name, makeTarget(this.gpu, spec, width, height));
    }
  }

  /** Acquires the cached targets that the frame reads, and draws those whose contents no plan has drawn yet; yields after each pass. */
  private *drawCachedTargets(drawn: readonly { bound: BoundPass; visible: boolean }[], frame: Frame): Generator<void> {
    const read = new Set(drawn.flatMap(({ bound, visible }) => (visible ? targetsRead(bound.pass) : [])));
    for (const [name, digest] of Object.entries(this.plan.kept)) {
      if (!read.has(name)) continue;
      const key = this.cacheKey(name, digest, frame);
      const held = this.cached.get(name);
      if (held?.key === key) continue;
      const make = () => ({ ...this.makeFixedTarget(name), drawn: false });
      this.cached.set(name, { key, lease: this.gpu.cachedTargets.acquire(key, make) });
      held?.lease.release();
    }
    const undrawn = new Map([...this.cached].map(([name, { lease }]) => [name, lease.value] as const).filter(([, { drawn }]) => !drawn));
    if (undrawn.size === 0) return;
    const intermediate = new Map<string, Target>();
    try {
      for (const index of passesInto(this.plan, this.setupPasses, undrawn.keys())) {
        const bound = this.passes.get(index);
        if (bound === undefined) throw new Error(`The program of setup pass ${index} is not compiled.`);
        const { target } = bound.pass;
        if (!undrawn.has(target) && !intermediate.has(target)) intermediate.set(target, this.makeFixedTarget(target));
        this.drawPass(bound, frame, (name) => undrawn.get(name) ?? intermediate.get(name));
        yield;
      }
      for (const target of undrawn.values()) target.drawn = true;
    } finally {
      for (const target of intermediate.values()) deleteTarget(this.gpu.gl, target);
    }
  }

  /** Key of a cached target's contents: the plan's digest, and the numbers that its passes read of live fields and steps of time. */
  private cacheKey(name: string, digest: string, frame: Frame): string {
    const contents = this.rough ? ROUGH + digest : digest;
    const rules = passesInto(this.plan, this.setupPasses, [name])
      .flatMap((index) => this.passes.get(index)?.bindings.uniforms ?? [])
      .flatMap(({ uniform }) => (uniform.rules.some((rule) => isLive(rule) || isStepped(rule)) ? uniform.rules : []));
    const state = { ...frame, targetWidth: 0, targetHeight: 0 };
    return rules.length === 0 ? contents : `${contents} ${JSON.stringify(rules.map((rule) => evaluate(liveRule(rule, frame.scene), state)))}`;
  }

  private makeFixedTarget(name: string): Target {
    const spec = this.plan.targets[name];
    if (spec === undefined) throw new Error(`The plan has no target ${name}.`);
    return makeTarget(this.gpu, spec, ...targetSize(spec, 0, 0));
  }

  /** Clears the target of a pass that shows nothing in this frame. */
  private clearTarget({ target }: Pass): void {
    const { gl } = this.gpu;
    gl.bindFramebuffer(gl.FRAMEBUFFER, requireTarget(this.targets.get(target), target).framebuffer);
    gl.disable(gl.SCISSOR_TEST);
    this.clear();
  }

  private clear(): void {
    const { gl } = this.gpu;
    gl.depthMask(true);
    gl.clearColor(0, 0, 0, 0);
    gl.clearDepth(1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }

  private drawPass({ pass, program, mesh, bindings }: BoundPass, frame: Frame, find: (name: string) => Target | undefined): void {
    const { gl } = this.gpu;
    const { time, camera, width, height } = frame;
    const target =
      pass.target === "screen"
        ? { framebuffer: frame.screen, texture: null, mipmapped: false, width, height }
        : requireTarget(find(pass.target), pass.target);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    gl.viewport(0, 0, target.width, target.height);
    this.setState(pass, frame.scissor);
    gl.useProgram(program.handle);
    const size = { width, height, targetWidth: target.width, targetHeight: target.height };
    uploadUniforms(gl, bindings, { time, camera, ...size }, frame.scene);
    bindSamplers(gl, bindings, find);
    mesh.draw();
    unbindSamplers(gl, bindings);
    if (target.mipmapped) {
      gl.activeTexture(gl.TEXTURE0);
      gl.bindTexture(gl.TEXTURE_2D, target.texture);
      gl.generateMipmap(gl.TEXTURE_2D);
      gl.bindTexture(gl.TEXTURE_2D, null);
    }
  }

  private setState({ target, state: { blend, depth, equal, clear } }: Pass, scissor: Rectangle | null): void {
    const { gl } = this.gpu;
    // The scissor applies to the screen only: passes may read any pixel of a target.
    if (target === "screen" && scissor) {
      gl.enable(gl.SCISSOR_TEST);
      gl.scissor(scissor.x, scissor.y, scissor.width, scissor.height);
    } else {
      gl.disable(gl.SCISSOR_TEST);
    }
    if (blend === "none" && !this.gpu.capabilities.alwaysBlends) {
      gl.disable(gl.BLEND);
    } else {
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, blend === "none" ? gl.ZERO : blend === "add" ? gl.ONE : gl.ONE_MINUS_SRC_ALPHA);
    }
    gl.disable(gl.CULL_FACE);
    gl.depthMask(true);
    gl.depthFunc(equal ? gl.EQUAL : gl.LESS);
    if (depth) gl.enable(gl.DEPTH_TEST);
    else gl.disable(gl.DEPTH_TEST);
    if (clear) this.clear();
  }
}

function requireTarget(target: Target | undefined, name: string): Target {
  if (target === undefined) throw new Error(`The plan has no target ${name}.`);
  return target;
}
