/** `window.seafoam`: lets a test draw what the page draws, and read it back. */
import type { Api } from "./api";
import { cameraFromScene, type CameraState } from "./camera/state";
import type { Viewport } from "./display/viewport";
import type { FramePlan } from "./generated/api";
import type { Gpu } from "./gl/gpu";
import { clearErrors, makeScreen, readPixels } from "./gl/resources";
import { Executor } from "./plan/executor";
import { compileErrors } from "./plan/programs";

interface RenderOptions {
  time: number;
  width: number;
  height: number;
  camera?: CameraState; // The preset's by default; required with a plan
  quality?: string; // Tier, for a preset
}

interface Rendered {
  pixels: string; // RGBA8, rows from the top, base64
  glError: number;
  /** SHA-256 of the sources that the driver holds. */
  sources: Record<string, { vertex: string; fragment: string }>;
}

declare global {
  interface Window { seafoam: ReturnType<typeof makeTestHook>; }
}

/** `ready`: resolves with the first frame; rejects if none can be drawn. */
export function makeTestHook(api: Api, viewport: Viewport | null, ready: Promise<void>, state: () => unknown) {
  let extension: WEBGL_lose_context | null = null;
  const gpu = (): Gpu => {
    if (viewport === null) throw new Error("This page draws nothing itself.");
    return viewport.gpu;
  };
  return {
    ready,
    renderer: viewport?.gpu.capabilities.renderer ?? "server",
    render: (planOrPreset: FramePlan | string, options: RenderOptions): Promise<Rendered> => renderOffscreen(gpu(), api, planOrPreset, options),
    /** Compiles a plan's programs; returns the errors. */
    compile: (plan: FramePlan): Promise<string[]> => compileErrors(gpu(), plan),
    loseContext: () => {
      // Once the context is lost, the extension is not available.
      extension = viewport?.gl.getExtension("WEBGL_lose_context") ?? null;
      extension?.loseContext();
    },
    restoreContext: () => extension?.restoreContext(),
    state,
  };
}

async function renderOffscreen(gpu: Gpu, api: Api, planOrPreset: FramePlan | string, options: RenderOptions): Promise<Rendered> {
  const { gl } = gpu;
  const { time, width, height, camera, quality = "standard" } = options;
  const isPreset = typeof planOrPreset === "string";
  const plan = isPreset ? await api.presetPlan(planOrPreset, quality) : planOrPreset;
  const eye = camera ?? (isPreset ? cameraFromScene((await api.preset(planOrPreset)).scene) : null);
  if (eye === null) throw new Error("A plan requires a camera.");
  const executor = await Executor.load(gpu, plan, api.texture, eye, false);
  const screen = makeScreen(gl, width, height);
  try {
    clearErrors(gl);
    executor.draw({ time, camera: eye, width, height, screen: screen.framebuffer, scissor: null, scene: null });
    const pixels = readPixels(gl, screen.framebuffer, width, height, new Uint8Array(width * height * 4));
    const glError = gl.getError();
    const sources: Rendered["sources"] = {};
    for (const [name, program] of executor.programs) {
      sources[name] = {
        vertex: await sha256(gl.getShaderSource(program.vertex) ?? ""),
        fragment: await sha256(gl.getShaderSource(program.fragment) ?? ""),
      };
    }
    return { pixels: base64(pixels), glError, sources };
  } finally {
    screen.dispose();
    executor.dispose();
  }
}

function base64(bytes: Uint8Array): string {
  const parts: string[] = [];
  for (let i = 0; i < bytes.length; i += 0x8000) parts.push(String.fromCharCode(...bytes.subarray(i, i + 0x8000)));
  return btoa(parts.join(""));
}

async function sha256(text: string): Promise<string> {
  // eslint-disable-next-line no-restricted-properties -- tests that ask for it are served by localhost
  const digest = await crypto.subtle.digest("SHA-256", new TextEncoder().encode(text));
  return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}
