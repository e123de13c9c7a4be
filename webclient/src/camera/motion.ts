/** How the camera moves: every step takes a state and gives the next one. */
import { basis, type CameraState, type Vec3 } from "./state";

/** Short of straight up and down, where a drag sideways would only spin the picture. */
const STEEPEST = 1.5;
const FARTHEST = 1e5;
const FOV = [0.1, 2.0] as const;

const clamp = (x: number, low: number, high: number) => Math.min(high, Math.max(low, x));

/** Yaw in [−π, π], so that no number of turns leaves the range that the server accepts. */
function turn(yaw: number): number {
  return yaw - 2 * Math.PI * Math.round(yaw / (2 * Math.PI));
}

/** Keeps the eye above the water and within what a scene may hold. */
function place([x, y, z]: Vec3, lowest: number): Vec3 {
  return [clamp(x, -1e7, 1e7), clamp(y, lowest, FARTHEST), clamp(z, -1e7, 1e7)];
}

/** Turns the head. */
export function look(camera: CameraState, yaw: number, pitch: number): CameraState {
  return { ...camera, yaw: turn(camera.yaw + yaw), pitch: clamp(camera.pitch + pitch, -STEEPEST, STEEPEST) };
}

/** Moves along the view, sideways, and up. */
export function move(camera: CameraState, right: number, up: number, forward: number, lowest: number): CameraState {
  const axes = basis({ ...camera, roll: 0 });
  const position = camera.position.map(
    (c, i) => c + (axes.right[i] ?? 0) * right + (axes.forward[i] ?? 0) * forward + (i === 1 ? up : 0),
  ) as unknown as Vec3;
  return { ...camera, position: place(position, lowest) };
}

export interface Pivot {
  point: Vec3;
  /** From the eye, m. */
  distance: number;
}

/** What an orbit turns about: where the view meets still water, but neither at the feet nor at the horizon. */
export function pivot(camera: CameraState): Pivot {
  const { forward } = basis(camera);
  const reach = forward[1] < 0 ? camera.position[1] / -forward[1] : Infinity;
  const distance = clamp(reach, 2, Math.max(8, 8 * camera.position[1]));
  return { point: camera.position.map((c, i) => c + (forward[i] ?? 0) * distance) as unknown as Vec3, distance };
}

/** Turns about a point that stays where it is in the picture. */
export function orbit(camera: CameraState, about: Pivot, yaw: number, pitch: number, lowest: number): CameraState {
  // The steepest rise that keeps the eye out of the water.
  const highest = Math.asin(clamp((about.point[1] - lowest) / about.distance, -1, 1));
  const wanted = clamp(camera.pitch + pitch, -STEEPEST, STEEPEST);
  const turned = { ...camera, yaw: turn(camera.yaw + yaw), pitch: Math.min(wanted, Math.max(highest, camera.pitch)) };
  const { forward } = basis(turned);
  const position = about.point.map((c, i) => c - (forward[i] ?? 0) * about.distance) as unknown as Vec3;
  return { ...turned, position: place(position, lowest) };
}

/** Goes toward what is in the middle of the picture; factor 0.5 halves the distance. */
export function zoom(camera: CameraState, factor: number, lowest: number): CameraState {
  const { distance } = pivot(camera);
  return move(camera, 0, 0, distance * (1 - factor), lowest);
}

/** Widens or narrows the view. */
export function widen(camera: CameraState, factor: number): CameraState {
  return { ...camera, fov: clamp(camera.fov * factor, FOV[0], FOV[1]) };
}
