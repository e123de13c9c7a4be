/**
 * Selects the passes that a picture needs: those that can be visible, and those whose targets these read.
 *
 * The server has the same rules (framegraph/visibility.py); tests/golden/views.json pins both.
 */
import { basis, type CameraState } from "../camera/state";
import type { BoundingSphere, FramePlan, Pass } from "../generated/api";

/** Above all crests, below all troughs, or between. */
export type Eye = "over" | "between" | "under";

type Vector = readonly [number, number, number];

const HORIZON_MARGIN = 0.01; // Slope within which a ray may meet water or sky

export function eyeOf(plan: Pick<FramePlan, "top" | "trough">, camera: CameraState): Eye {
  const height = camera.position[1];
  return height >= plan.top ? "over" : height >= plan.trough ? "between" : "under";
}

export const appliesTo = (pass: Pick<Pass, "eye">, eye: Eye) => pass.eye === "any" || pass.eye.includes(eye);

/** Indices of the passes to draw, in order; false: the pass shows nothing, its target is cleared. */
export function drawnPasses(
  plan: Pick<FramePlan, "passes" | "top">,
  eye: Eye,
  camera: CameraState,
  width: number,
  height: number,
): Map<number, boolean> {
  const needed = new Set(["screen"]);
  const drawn: [number, boolean][] = [];
  for (const [index, pass] of [...plan.passes.entries()].reverse()) {
    if (!appliesTo(pass, eye) || !needed.has(pass.target)) continue;
    const shows = inView(pass.view, plan.top, camera, width, height);
    if (shows || pass.state.clear) drawn.push([index, shows]);
    if (!shows) continue;
    for (const name of targetsRead(pass)) needed.add(name);
  }
  return new Map(drawn.reverse());
}

/** Those of the passes that draw into `targets`, or into targets that they read, in order. */
export function passesInto(plan: Pick<FramePlan, "passes">, among: readonly number[], targets: Iterable<string>): number[] {
  const needed = new Set(targets);
  const positions: number[] = [];
  for (const index of among.toSorted((a, b) => b - a)) {
    const pass = plan.passes[index];
    if (pass === undefined || !needed.has(pass.target)) continue;
    positions.push(index);
    for (const name of targetsRead(pass)) needed.add(name);
  }
  return positions.reverse();
}

export function targetsRead(pass: Pick<Pass, "inputs">): string[] {
  return Object.values(pass.inputs ?? {}).flatMap((source) => ("target" in source ? [source.target] : []));
}

function inView(view: Pass["view"], top: number, camera: CameraState, width: number, height: number): boolean {
  if (view === "any") return true;
  const { right, up, forward } = basis(camera);
  const tangent = Math.tan(camera.fov / 2);
  const sides = [[right, (tangent * width) / height], [up, tangent]] as const;
  if (typeof view !== "string") return view.some((sphere) => intersectsFrustum(sphere, camera, forward, sides));
  if (camera.position[1] < top) return true;
  const spread = sides.reduce((sum, [axis, slope]) => sum + slope * Math.abs(axis[1]), 0);
  return view === "rising" ? forward[1] + spread >= -HORIZON_MARGIN : forward[1] - spread <= HORIZON_MARGIN;
}

/** Whether a sphere intersects the view frustum; conservative near its edges. */
function intersectsFrustum(sphere: BoundingSphere, camera: CameraState, forward: Vector, sides: readonly (readonly [Vector, number])[]): boolean {
  const [x, y, z] = sphere.centre;
  const [ex, ey, ez] = camera.position;
  const toCentre: Vector = [x - ex, y - ey, z - ez];
  const depth = dot(toCentre, forward);
  if (depth < -sphere.radius) return false;
  return sides.every(([axis, reach]) => Math.abs(dot(toCentre, axis)) - depth * reach <= sphere.radius * Math.hypot(1, reach));
}

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
