/** What the machine can do, asked for once, and what a plan needs of it. */
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

export type ExtensionName = (typeof EXTENSIONS)[number];

export interface Capabilities {
  extensions: ReadonlySet<ExtensionName>;
  /** The driver's own name, where the browser tells. */
  renderer: string;
  /** Draws on the CPU: timer queries are not to be believed, and every pixel is dear. */
  software: boolean;
  /** llvmpipe compiles a program twice for a state that hides what was there: blended with none of it, once. */
  alwaysBlends: boolean;
}

/** Thrown where the machine lacks what a picture needs; the message is for the visitor. */
export class CapabilityError extends Error {
  override readonly name = "CapabilityError";
}

/** Turns on what is there. `hidden`: extensions to act without, for tests. */
export function detect(gl: WebGL2RenderingContext, hidden: ReadonlySet<string>): Capabilities {
  const extensions = new Set(EXTENSIONS.filter((name) => !hidden.has(name) && gl.getExtension(name) !== null));
  const info = extensions.has("WEBGL_debug_renderer_info") ? gl.getExtension("WEBGL_debug_renderer_info") : null;
  const renderer = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  if (!extensions.has("EXT_color_buffer_float") && !extensions.has("EXT_color_buffer_half_float")) {
    throw new CapabilityError(
      "This graphics driver cannot draw into floating-point pictures (EXT_color_buffer_float), " +
        "which the light of the sea is computed in.",
    );
  }
  const software = /llvmpipe|softpipe|swiftshader|software|basic render/i.test(renderer);
  return { extensions, renderer, software, alwaysBlends: /llvmpipe/i.test(renderer) && extensions.has("EXT_float_blend") };
}

/** Refuses a plan that the machine cannot draw, before anything is compiled. */
export function requireSupport(plan: FramePlan, { extensions }: Capabilities): void {
  const needs = new Map<ExtensionName, string>();
  for (const target of Object.values(plan.targets)) {
    if (target.format === "RGBA32F") {
      needs.set("EXT_color_buffer_float", "32-bit float targets");
      if (target.filter !== "nearest") needs.set("OES_texture_float_linear", "filtered 32-bit float textures");
    }
  }
  for (const texture of Object.values(plan.textures)) {
    if (texture.format.endsWith("32F") && texture.filter !== "nearest") {
      needs.set("OES_texture_float_linear", "filtered 32-bit float textures");
    }
  }
  const missing = [...needs].filter(([name]) => !extensions.has(name));
  if (missing.length > 0) {
    throw new CapabilityError(
      `This picture needs ${missing.map(([name, what]) => `${what} (${name})`).join(" and ")}, ` +
        "which this graphics driver does not offer. Another quality may do without.",
    );
  }
}
