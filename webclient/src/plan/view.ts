/**
 * Which passes a picture needs: those that can show something in it, and what these read.
 *
 * The server carries the same few lines (framegraph/visibility.py); tests/golden/views.json pins both.
 */
import { basis, type CameraState } from "../camera/state";
import type { Ball, FramePlan, Pass } from "../generated/api";

/** Where the eye is: over all crests, or where one may cover it. */
export type Eye = "over" | "under";

type Vector = readonly [number, number, number];

/** Rays that fall or rise by less, of the picture's middle ray, may meet either water or sky. */
const LEVEL = 0.01;

export function eyeOf(plan: Pick<FramePlan, "top">, camera: CameraState): Eye {
  return camera.position[1] >= plan.top ? "over" : "under";
}

export function serves(pass: Pick<Pass, "eye">, eye: Eye): boolean {
  return pass.eye === "any" || pass.eye === eye;
}

/** Positions of the passes that the screen needs, in drawing order; false: only to clear what it draws into. */
export function drawnPasses(
  plan: Pick<FramePlan, "passes" | "top">,
  eye: Eye,
  camera: CameraState,
  width: number,
  height: number,
): Map<number, boolean> {
  const needed = new Set(["screen"]);
  const found: [number, boolean][] = [];
  for (const [index, pass] of [...plan.passes.entries()].reverse()) {
    if (!serves(pass, eye) || !needed.has(pass.target)) continue;
    const shows = inView(pass.view, plan.top, camera, width, height);
    if (shows || pass.state.clear) found.push([index, shows]);
    if (!shows) continue;
    for (const name of targetsRead(pass)) needed.add(name);
  }
  return new Map(found.reverse());
}

/** Of the passes at these positions those that draw into `targets` or into what these read, in drawing order. */
export function passesInto(plan: Pick<FramePlan, "passes">, among: readonly number[], targets: Iterable<string>): number[] {
  const needed = new Set(targets);
  const found: number[] = [];
  for (const index of among.toSorted((a, b) => b - a)) {
    const pass = plan.passes[index];
    if (pass === undefined || !needed.has(pass.target)) continue;
    found.push(index);
    for (const name of targetsRead(pass)) needed.add(name);
  }
  return found.reverse();
}

export function targetsRead(pass: Pick<Pass, "inputs">): string[] {
  return Object.values(pass.inputs ?? {}).flatMap((source) => ("target" in source ? [source.target] : []));
}

function inView(view: Pass["view"], top: number, camera: CameraState, width: number, height: number): boolean {
  if (view === "any") return true;
  const { right, up, forward } = basis(camera);
  const tangent = Math.tan(camera.fov / 2);
  const sides = [
    [right, (tangent * width) / height],
    [up, tangent],
  ] as const;
  if (typeof view !== "string") return view.some((ball) => meets(ball, camera, forward, sides));
  if (camera.position[1] < top) return true;
  const spread = sides.reduce((sum, [axis, reach]) => sum + reach * Math.abs(axis[1]), 0);
  return view === "rising" ? forward[1] + spread >= -LEVEL : forward[1] - spread <= LEVEL;
}

/** Whether a ball meets the pyramid of the picture's rays; it may say yes to one that only comes near an edge. */
function meets(ball: Ball, camera: CameraState, forward: Vector, sides: readonly (readonly [Vector, number])[]): boolean {
  const [x, y, z] = ball.centre;
  const [ex, ey, ez] = camera.position;
  const way: Vector = [x - ex, y - ey, z - ez];
  const ahead = dot(way, forward);
  if (ahead < -ball.radius) return false;
  return sides.every(
    ([axis, reach]) => Math.abs(dot(way, axis)) - ahead * reach <= ball.radius * Math.hypot(1, reach),
  );
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
