/** Capabilities of the WebGL context, and those that a plan requires. */
import type { FramePlan } from "../generated/api";

/** Every extension that the client uses. */
const EXTENSIONS = [
  "EXT_color_buffer_float",
  "EXT_color_buffer_half_float",
  "EXT_float_blend",
  "OES_texture_float_linear",
  "KHR_parallel_shader_compile",
  "EXT_disjoint_timer_query_webgl2",
  "WEBGL_lose_context",
  "WEBGL_debug_renderer_info",
] as const;

type ExtensionName = (typeof EXTENSIONS)[number];

export interface Capabilities {
  extensions: ReadonlySet<ExtensionName>;
  renderer: string; // The driver's name, if the browser reveals it
  software: boolean; // Renders on the CPU
  /** Blends with (one, zero) instead of disabling blending: llvmpipe compiles a program for each of the two states. */
  alwaysBlends: boolean;
  largestTarget: number; // Greatest width and height of a target
}

/** A required capability is missing; the message is for the user. */
export class CapabilityError extends Error {
  override readonly name = "CapabilityError";
}

/** Enables extensions, without those in `hidden`. */
export function detect(gl: WebGL2RenderingContext, hidden: ReadonlySet<string>): Capabilities {
  const extensions = new Set(EXTENSIONS.filter((name) => !hidden.has(name) && gl.getExtension(name) !== null));
  const info = extensions.has("WEBGL_debug_renderer_info") ? gl.getExtension("WEBGL_debug_renderer_info") : null;
  const renderer = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  if (!extensions.has("EXT_color_buffer_float") && !extensions.has("EXT_color_buffer_half_float")) {
    const either = "EXT_color_buffer_float or EXT_color_buffer_half_float";
    throw new CapabilityError(`The graphics driver cannot render to floating-point textures (${either} is required).`);
  }
  const software = /llvmpipe|softpipe|swiftshader|software|basic render/i.test(renderer);
  const alwaysBlends = /llvmpipe/i.test(renderer) && extensions.has("EXT_float_blend");
  const largestTarget = Math.min(gl.getParameter(gl.MAX_TEXTURE_SIZE) as number, gl.getParameter(gl.MAX_RENDERBUFFER_SIZE) as number);
  return { extensions, renderer, software, alwaysBlends, largestTarget };
}

/** Throws a `CapabilityError` for a plan that the machine cannot draw. */
export function requireSupport(plan: FramePlan, { extensions }: Capabilities): void {
  const isFloat = ({ format }: { format: string }) => format.endsWith("32F");
  const targets = Object.values(plan.targets).filter(isFloat);
  const filtered = [...targets, ...Object.values(plan.textures).filter(isFloat)].some(({ filter }) => filter !== "nearest");
  const needs = [
    ["EXT_color_buffer_float", "32-bit float targets", targets.length > 0],
    ["OES_texture_float_linear", "filtered 32-bit float textures", filtered],
  ] as const;
  const missing = needs.flatMap(([name, feature, needed]) => (needed && !extensions.has(name) ? `${feature} (${name})` : []));
  if (missing.length > 0) throw new CapabilityError(`The graphics driver does not support ${missing.join(" and ")}. Select another quality.`);
}
