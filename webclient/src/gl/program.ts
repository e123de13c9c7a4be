/** Programs: compiled and linked asynchronously, with errors by file and line. */
import type { Program as ProgramSource, Shader } from "../generated/api";
import type { Capabilities } from "./capabilities";

const POLL_INTERVAL = 4;
/** Time after which the link status is read without waiting further, ms: some drivers never report completion while another page draws. */
const LINK_TIMEOUT = 3000;

/** `type`: GL enum of its type. */
export interface ActiveUniform { location: WebGLUniformLocation; type: number; size: number; }

export interface Program {
  handle: WebGLProgram;
  vertex: WebGLShader;
  fragment: WebGLShader;
  source: ProgramSource;
  uniforms: ReadonlyMap<string, ActiveUniform>; // Set once the program is linked; arrays without "[0]"
}

/** A compiler's messages, by file and line of the GLSL tree. */
class ShaderError extends Error {
  override readonly name = "ShaderError";
}

/** Starts compiling and linking; no result is read, so the driver may work in the background. */
export function startProgram(gl: WebGL2RenderingContext, source: ProgramSource): Program {
  const compile = (type: number, text: string): WebGLShader => {
    // Null only if the context is lost: later calls with it are ignored.
    const shader = gl.createShader(type) as WebGLShader;
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    return shader;
  };
  const vertex = compile(gl.VERTEX_SHADER, source.vertex.text);
  const fragment = compile(gl.FRAGMENT_SHADER, source.fragment.text);
  const handle = gl.createProgram();
  gl.attachShader(handle, vertex);
  gl.attachShader(handle, fragment);
  gl.bindAttribLocation(handle, 0, "a_grid");
  gl.linkProgram(handle);
  return { handle, vertex, fragment, source, uniforms: new Map() };
}

/** Resolves when `finishProgram` would not block, or after a timeout. */
export async function whenReady(gl: WebGL2RenderingContext, program: Program, { extensions }: Capabilities): Promise<void> {
  const parallel = extensions.has("KHR_parallel_shader_compile") ? gl.getExtension("KHR_parallel_shader_compile") : null;
  // Where the driver does not say when a program is linked, a fence behind its commands does.
  if (parallel === null) return whenDone(gl, LINK_TIMEOUT);
  // Compilation starts when the commands are flushed.
  gl.flush();
  await poll(gl, LINK_TIMEOUT, () => gl.getProgramParameter(program.handle, parallel.COMPLETION_STATUS_KHR) === true);
}

/** Resolves when the driver has executed all commands so far: until then reading anything back would wait for them. */
export async function whenDone(gl: WebGL2RenderingContext, timeout: number): Promise<void> {
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.flush();
  if (fence === null) return;
  await poll(gl, timeout, () => gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED);
  gl.deleteSync(fence);
}

async function poll(gl: WebGL2RenderingContext, timeout: number, done: () => boolean): Promise<void> {
  const deadline = performance.now() + timeout;
  while (!done() && !gl.isContextLost() && performance.now() < deadline) {
    await new Promise((resolve) => setTimeout(resolve, POLL_INTERVAL));
  }
}

/** Checks the link and reads the active uniforms; throws a `ShaderError` that names file and line. */
export function finishProgram(gl: WebGL2RenderingContext, program: Program, name: string): void {
  if (program.uniforms.size > 0 || gl.isContextLost()) return;
  if (gl.getProgramParameter(program.handle, gl.LINK_STATUS) !== true) {
    const log = (shader: WebGLShader, stage: Shader) => annotate(gl.getShaderInfoLog(shader) ?? "", stage);
    const { vertex, fragment, source } = program;
    const messages = [log(vertex, source.vertex), log(fragment, source.fragment), gl.getProgramInfoLog(program.handle) ?? ""];
    throw new ShaderError(`Program ${name}: ${messages.map((s) => s.trim()).filter(Boolean).join("\n")}`);
  }
  const uniforms = new Map<string, ActiveUniform>();
  const count = gl.getProgramParameter(program.handle, gl.ACTIVE_UNIFORMS) as number;
  for (let i = 0; i < count; i++) {
    const info = gl.getActiveUniform(program.handle, i);
    const location = info && gl.getUniformLocation(program.handle, info.name);
    if (info && location) uniforms.set(info.name.replace(/\[0\]$/, ""), { location, type: info.type, size: info.size });
  }
  program.uniforms = uniforms;
}

/** Replaces "0:123" in a compiler's log by the file of line 123 and the line in it. */
export function annotate(log: string, shader: Shader): string {
  const files = [...shader.files].sort((a, b) => a.line - b.line);
  return log.replaceAll("\0", "").replace(/\b\d+:(\d+)(?=[:(])/g, (match, digits: string) => {
    const line = Number(digits);
    const file = files.findLast((candidate) => candidate.line <= line);
    return file ? `${file.path}:${line - file.line + 1}` : match;
  });
}

export function deleteProgram(gl: WebGL2RenderingContext, program: Program): void {
  gl.deleteProgram(program.handle);
  gl.deleteShader(program.vertex);
  gl.deleteShader(program.fragment);
}
