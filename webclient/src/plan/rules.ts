/**
 * Uniform rules, evaluated as the server does: periodic values are reduced in float64, before shaders use them as float32.
 * Live fields are fields of the scene whose values are uniforms, so that a change needs no new plan.
 */
import { basis, type CameraState } from "../camera/state";
import type { CameraRule, FramePlan, Uniform } from "../generated/api";
import { diff, get, type Json } from "../scene/json";

export type Rule = Uniform["rules"][number];

export interface FrameState {
  time: number; // s
  camera: CameraState;
  /** Size of the picture, pixels: the camera's aspect. */
  width: number;
  height: number;
  /** Size of the target that the pass draws into, pixels. */
  targetWidth: number;
  targetHeight: number;
}

const TWO_PI = 2 * Math.PI;

/** x modulo period in [0, period); a small negative x that rounds up to the period gives 0. */
function modulo(x: number, period: number): number {
  const r = x % period;
  if (r >= 0) return r;
  return r + period >= period ? 0 : r + period;
}

function phase(x: number): number {
  const r = x % TWO_PI;
  if (r > Math.PI) return r - TWO_PI;
  if (r < -Math.PI) return r + TWO_PI;
  return r;
}

function camera(rule: CameraRule, state: FrameState): number[] {
  const { position, fov } = state.camera;
  const q = Math.tan(fov / 2);
  const aspect = state.width / state.height;
  const { right, up, forward } = basis(state.camera);
  switch (rule.what) {
    case "eye_height": return [position[1]];
    case "ray_x": return right.map((c) => c * q * aspect);
    case "ray_y": return up.map((c) => c * q);
    case "ray_z": return [...forward];
    case "view_projection": {
      // P·V with an infinite far plane; V turns by (R, U, −F) after lowering by the eye's height.
      const near = Math.max(0.02, 0.5 * (position[1] - rule.top));
      const sx = 1 / (q * aspect);
      const sy = 1 / q;
      const y = position[1];
      const rows = [
        [...right.map((c) => c * sx), -right[1] * y * sx],
        [...up.map((c) => c * sy), -up[1] * y * sy],
        [...forward, -forward[1] * y - 2 * near],
        [...forward, -forward[1] * y],
      ];
      return [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column] ?? 0));
    }
  }
}

export function evaluate(rule: Rule, state: FrameState): readonly number[] {
  const [ox, , oz] = state.camera.position;
  switch (rule.rule) {
    case "constant": return rule.value;
    case "phase": return [phase(rule.offset + rule.rate * state.time + (rule.k[0] * ox + rule.k[1] * oz))];
    case "wrap":
      return [modulo(rule.offset + (rule.rate ?? 0) * state.time + (rule.k[0] * ox + rule.k[1] * oz), rule.period)];
    case "loop": return [modulo((rule.step ? state.time - modulo(state.time, rule.step) : state.time) + rule.offset, rule.period)];
    case "clamp": {
      const value = rule.offset + rule.rate * state.time + (rule.k[0] * ox + rule.k[1] * oz);
      return [Math.min(Math.max(value, rule.low), rule.high)];
    }
    case "camera": return camera(rule, state);
    case "viewport": {
      const [width, height] = rule.of === "picture" ? [state.width, state.height] : [state.targetWidth, state.targetHeight];
      return [rule.times * width, rule.times * height];
    }
  }
}

/** Writes the values of a uniform's rules into `out`; throws unless they fill it exactly. */
export function fill(rules: readonly Rule[], state: FrameState, out: Float32Array): void {
  let at = 0;
  for (const rule of rules) {
    const values = evaluate(rule, state);
    if (at + values.length > out.length) throw new RangeError("The rules have more numbers than the uniform.");
    out.set(values, at);
    at += values.length;
  }
  if (at !== out.length) throw new RangeError(`The rules have ${at} numbers, the uniform ${out.length}.`);
}

export const CAMERA_POINTER = "/camera"; // The camera's pointer in a scene: every plan covers every camera

const isWithin = (pointer: string, field: string) => pointer === field || pointer.startsWith(`${field}/`);

/** Whether the plan of one scene also draws another. A field that becomes null has no number of its own to draw with. */
export function planCovers(plan: Pick<FramePlan, "live">, planned: Json, requested: Json): boolean {
  return diff(planned, requested).every(([pointer, value]) =>
    value !== null && [CAMERA_POINTER, ...plan.live].some((field) => isWithin(pointer, field)),
  );
}

/** Whether a rule's number changes with time, but not in every frame. */
export const isStepped = (rule: Rule) => rule.rule === "loop" && typeof rule.step === "number";

/** Whether a rule has numbers that follow the scene's fields. */
export function isLive(rule: Rule): boolean {
  return (rule.rule === "constant" && typeof rule.field === "string") || (rule.rule === "clamp" && (rule.terms ?? []).length > 0);
}

/** The rule with the scene's numbers, if the scene has all that it names; else as the plan says for where they are absent. */
export function liveRule(rule: Rule, scene: Json | null): Rule {
  if (scene === null) return rule;
  if (rule.rule === "clamp") return { ...rule, offset: offset(rule.terms ?? [], scene) ?? rule.offset };
  if (rule.rule !== "constant" || typeof rule.field !== "string") return rule;
  const value = get(scene, rule.field);
  if (value === undefined && rule.absent) return { ...rule, value: rule.absent };
  const numbers = Array.isArray(value) ? value : [value];
  return numbers.length === rule.value.length && numbers.every((n) => typeof n === "number") ? { ...rule, value: numbers } : rule;
}

/** The sum of the terms in their order, as the server adds them; null where the scene lacks one of their fields. */
function offset(terms: readonly { field: string; factor: number }[], scene: Json): number | null {
  let sum = 0;
  for (const { field, factor } of terms) {
    const value = get(scene, field);
    if (typeof value !== "number") return null;
    sum += factor * value;
  }
  return terms.length > 0 ? sum : null;
}
