import { describe, expect, it } from "vitest";
import type { CameraState } from "../../src/camera/state";
import type { FramePlan, Uniform } from "../../src/generated/api";
import { Gpu } from "../../src/gl/gpu";
import { Executor, type Frame } from "../../src/plan/executor";

const CAMERA: CameraState = { position: [0, 9, 0], yaw: 0, pitch: 0, roll: 0, fov: 1 };

/** A driver that draws nothing and counts by target what it is asked to draw; textures are known by their numbers. */
function driver() {
  const draws: string[] = [];
  const alive = new Set<unknown>();
  let numbered = 0;
  let into: { texture?: string } | null = null;
  const make = (kind: string) => {
    const object = { name: `${kind} ${numbered++}` };
    alive.add(object);
    return object;
  };
  const uniforms = new Map<unknown, string[]>();
  const calls: Record<string, (...args: never[]) => unknown> = {
    createProgram: () => make("program"),
    createShader: () => ({}),
    shaderSource: (shader: object, text: string) => Object.assign(shader, { text }),
    attachShader: (program: object, shader: { text: string }) => {
      const names = [...shader.text.matchAll(/uniform \w+ (\w+)/g)].map(([, name]) => name ?? "");
      uniforms.set(program, [...(uniforms.get(program) ?? []), ...names]);
    },
    getProgramParameter: (program: object, what: string) => (what === "ACTIVE_UNIFORMS" ? (uniforms.get(program) ?? []).length : true),
    getActiveUniform: (program: object, index: number) => {
      const name = uniforms.get(program)?.[index] ?? "";
      return { name, type: name.startsWith("t_") ? "SAMPLER_2D" : "FLOAT", size: 1 };
    },
    getUniformLocation: () => ({}),
    createTexture: () => make("texture"),
    createFramebuffer: () => make("framebuffer"),
    deleteTexture: (texture: unknown) => alive.delete(texture),
    deleteFramebuffer: (framebuffer: unknown) => alive.delete(framebuffer),
    deleteProgram: (program: unknown) => alive.delete(program),
    createVertexArray: () => ({}),
    bindFramebuffer: (_: string, framebuffer: { texture?: string } | null) => (into = framebuffer),
    framebufferTexture2D: (...[, , , texture]: [string, string, string, { name: string }]) => {
      if (into) into.texture = texture.name;
    },
    checkFramebufferStatus: () => "FRAMEBUFFER_COMPLETE",
    getSyncParameter: () => "SIGNALED",
    isContextLost: () => false,
    getExtension: () => null,
    drawArrays: () => draws.push(into?.texture ?? "screen"),
  };
  const get = (_: object, name: string) => (/^[A-Z0-9_]+$/.test(name) ? name : (calls[name] ?? (() => undefined)));
  const gl = new Proxy({}, { get }) as unknown as WebGL2RenderingContext;
  const gpu = new Gpu(gl, { extensions: new Set(), renderer: "none", software: true, alwaysBlends: false, largestTarget: 4096 });
  const textures = () => [...alive].filter((texture) => (texture as { name: string }).name.startsWith("texture")).length;
  return { gpu, draws, textures };
}

/** Two setup passes, one after the other, and one that reads what the second leaves. */
function plan(over: Partial<FramePlan> = {}): FramePlan {
  const shader = (text: string) => ({ text, sha256: text, files: [] });
  const program = (...uniforms: string[]) => ({ vertex: shader(""), fragment: shader(uniforms.map((name) => `uniform float ${name};`).join("\n")) });
  const still = { size: { rule: "fixed", width: 8, height: 4 }, format: "RGBA16F", depth: false, filter: "nearest", wrap: "repeat", layers: 1 } as const;
  const pass = { eye: "any", view: "any", mesh: { rule: "fullscreen" }, uniforms: {}, state: { depth: false, equal: false, clear: false, blend: "none" } } as const;
  return {
    ...{ version: 1, effects: [], skipped: [], textures: {}, linear: "screen", samples: 1, top: 0, trough: 0, bottom: -1, live: ["/colour"] },
    programs: { first: program("u_colour"), second: program("t_first"), last: program("t_still", "u_time") },
    targets: { first: still, still },
    passes: [
      { ...pass, name: "first", when: "setup", program: "first", target: "first", inputs: {} },
      { ...pass, name: "second", when: "setup", program: "second", target: "still", inputs: { t_first: { target: "first" } } },
      { ...pass, name: "last", when: "frame", program: "last", target: "screen", inputs: { t_still: { target: "still" } } },
    ],
    kept: { still: "what it hangs on" },
    uniforms: {
      u_colour: { type: "float", count: 1, rules: [{ rule: "constant", value: [0.5], field: "/colour" }] },
      u_time: { type: "float", count: 1, rules: [{ rule: "loop", period: 10, offset: 0 }] },
    },
    ...over,
  };
}

const load = (gpu: Gpu, framePlan: FramePlan) => Executor.load(gpu, framePlan, () => Promise.reject(new Error("no texture")), CAMERA, true);

const frame = (time: number, colour = 0.5): Frame => ({ time, camera: CAMERA, width: 16, height: 9, screen: null, scissor: null, scene: { colour } });

describe("setup passes", () => {
  it("are drawn for the first frame alone", async () => {
    const { gpu, draws, textures } = driver();
    const executor = await load(gpu, plan());
    executor.draw(frame(0));
    expect(draws).toHaveLength(3);
    expect(draws.at(-1)).toBe("screen");
    expect(textures(), "what was on the way is gone").toBe(1);
    for (const time of [1, 2]) executor.draw({ ...frame(time), width: 32 });
    expect(draws.slice(3)).toEqual(["screen", "screen"]);
  });

  it("are drawn again where a live field moves that they hang on", async () => {
    const { gpu, draws } = driver();
    const executor = await load(gpu, plan());
    for (const [colour, count] of [[0.5, 3], [0.6, 3], [0.6, 1], [0.5, 1]] as const) {
      const before = draws.length;
      executor.draw(frame(0, colour));
      expect(draws.length - before).toBe(count);
    }
  });

  it("are drawn again when a step of time begins that they hang on", async () => {
    const { gpu, draws } = driver();
    const stepped: Uniform = { type: "float", count: 1, rules: [{ rule: "loop", period: 10, offset: 0, step: 2 }] };
    const base = plan();
    const executor = await load(gpu, { ...base, uniforms: { ...base.uniforms, u_colour: stepped } });
    for (const [time, count] of [[2, 3], [3.9, 1], [4, 3], [5, 1], [-0.1, 3]] as const) {
      const before = draws.length;
      executor.draw(frame(time));
      expect(draws.length - before).toBe(count);
    }
  });

  it("are not drawn again for what they do not hang on", async () => {
    const { gpu, draws } = driver();
    const fixed: Uniform = { type: "float", count: 1, rules: [{ rule: "constant", value: [0.5], field: null }] };
    const base = plan();
    const executor = await load(gpu, { ...base, uniforms: { ...base.uniforms, u_colour: fixed } });
    for (const colour of [0.5, 0.6]) executor.draw(frame(0, colour));
    expect(draws).toHaveLength(4);
  });

  it("serve every plan that hangs on the same", async () => {
    const { gpu, draws, textures } = driver();
    const [first, other, third] = await Promise.all([load(gpu, plan()), load(gpu, plan({ samples: 2 })), load(gpu, plan({ kept: { still: "else" } }))]);
    first.draw(frame(0));
    other.draw(frame(0));
    expect(draws).toHaveLength(4);
    third.draw(frame(0));
    expect(draws).toHaveLength(7);
    first.dispose();
    other.draw(frame(1));
    expect(draws).toHaveLength(8);
    other.dispose();
    third.dispose();
    expect(textures(), "kept for the next plan").toBe(2);
    (await load(gpu, plan())).draw(frame(1));
    expect(draws).toHaveLength(9);
  });

  it("are not shared by what is drawn from rough textures", async () => {
    const { gpu, draws } = driver();
    const rough = { names: new Set<string>(), bytes: () => Promise.reject(new Error("no texture")) };
    (await Executor.load(gpu, plan(), rough.bytes, CAMERA, true, rough)).draw(frame(0));
    (await load(gpu, plan())).draw(frame(0));
    expect(draws, "the tables are drawn again").toHaveLength(6);
  });

  it("keep no more than a few targets that nobody uses", async () => {
    const { gpu, textures } = driver();
    const executor = await load(gpu, plan());
    for (let i = 0; i < 20; i++) executor.draw(frame(0, i));
    expect(textures()).toBeLessThanOrEqual(5);
  });

  it("are drawn again on a new context", async () => {
    for (const { gpu, draws } of [driver(), driver()]) {
      (await load(gpu, plan())).draw(frame(0));
      expect(draws).toHaveLength(3);
    }
  });

  it("wait until something is seen of them", async () => {
    const { gpu, draws } = driver();
    const base = plan();
    const passes = base.passes.map((pass) => (pass.when === "frame" ? { ...pass, view: "rising" as const } : pass));
    const executor = await load(gpu, { ...base, passes });
    executor.draw({ ...frame(0), camera: { ...CAMERA, pitch: -1.5 } });
    expect(draws).toHaveLength(0);
    executor.draw(frame(0));
    expect(draws).toHaveLength(3);
  });
});
