/** `window.seafoam`: lets a test draw exactly what the page draws, and read it back. */
import type { Api } from "./api";
import { type CameraState, cameraFromScene } from "./camera/state";
import type { FramePlan } from "./generated/api";
import type { Gpu } from "./gl/gpu";
import { makeScreen } from "./gl/target";
import { Executor } from "./plan/executor";

export interface RenderOptions {
  time: number;
  width: number;
  height: number;
  /** The preset's own by default; a plan by itself has none. */
  camera?: CameraState;
  /** Tier of quality, where a preset is named. */
  quality?: string;
}

export interface Rendered {
  /** RGBA8, rows from the top, base64. */
  pixels: string;
  glError: number;
  /** SHA-256 of the text that the driver holds. */
  sources: Record<string, { vertex: string; fragment: string }>;
}

export interface Hook {
  /** Resolves when the first picture is on the canvas; rejects where there will be none. */
  ready: Promise<void>;
  renderer: string;
  render(planOrPreset: FramePlan | string, options: RenderOptions): Promise<Rendered>;
  /** Compiles a plan's programs; gives the errors. */
  compile(plan: FramePlan): Promise<string[]>;
  loseContext(): void;
  restoreContext(): void;
  state(): unknown;
}

declare global {
  interface Window {
    seafoam: Hook;
  }
}

/** Draws one frame into a picture of its own, beside whatever the page draws. */
export async function renderOffscreen(
  gpu: Gpu,
  api: Api,
  planOrPreset: FramePlan | string,
  { time, width, height, camera, quality = "standard" }: RenderOptions,
): Promise<Rendered> {
  const { gl } = gpu;
  const byName = typeof planOrPreset === "string";
  const plan = byName ? await api.presetPlan(planOrPreset, quality) : planOrPreset;
  const from = camera ?? (byName ? cameraFromScene((await api.preset(planOrPreset)).scene) : null);
  if (from === null) throw new Error("a plan by itself has no camera: give one");
  const executor = await Executor.load(gpu, plan, (texture) => api.texture(texture), from, false);
  const screen = makeScreen(gl, width, height);
  try {
    // Errors of before are not this frame's.
    while (gl.getError() !== gl.NO_ERROR && !gl.isContextLost());
    executor.draw({ time, camera: from, width, height, screen: screen.framebuffer, scissor: null, scene: null });
    const pixels = new Uint8Array(width * height * 4);
    gl.bindFramebuffer(gl.FRAMEBUFFER, screen.framebuffer);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const glError = gl.getError();
    const sources: Rendered["sources"] = {};
    for (const [name, program] of executor.programs) {
      sources[name] = {
        vertex: await sha256(gl.getShaderSource(program.vertex) ?? ""),
        fragment: await sha256(gl.getShaderSource(program.fragment) ?? ""),
      };
    }
    return { pixels: base64(flipped(pixels, width, height)), glError, sources };
  } finally {
    screen.dispose();
    executor.dispose();
  }
}

function flipped(pixels: Uint8Array, width: number, height: number): Uint8Array {
  const row = width * 4;
  const out = new Uint8Array(pixels.length);
  for (let y = 0; y < height; y++) out.set(pixels.subarray(y * row, (y + 1) * row), (height - 1 - y) * row);
  return out;
}

function base64(bytes: Uint8Array): string {
  const parts: string[] = [];
  for (let i = 0; i < bytes.length; i += 0x8000) parts.push(String.fromCharCode(...bytes.subarray(i, i + 0x8000)));
  return btoa(parts.join(""));
}

async function sha256(text: string): Promise<string> {
  const digest = await crypto.subtle.digest("SHA-256", new TextEncoder().encode(text));
  return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}
