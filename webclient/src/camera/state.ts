/** The camera's state (float64, metres and radians), its axes, and its motion: functions from a state to the next. */

export type Vec3 = readonly [number, number, number];

export interface CameraState {
  position: Vec3; // Eye; y relative to still water
  yaw: number; // Heading, from −z toward +x
  pitch: number; // Elevation of the view
  roll: number;
  fov: number; // Vertical field of view
}

export function basis({ yaw, pitch, roll }: CameraState): Record<"right" | "up" | "forward", Vec3> {
  const [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
  const right: Vec3 = [cy, 0, sy];
  const up: Vec3 = [-sy * sp, cp, cy * sp];
  const [cr, sr] = [Math.cos(roll), Math.sin(roll)];
  const mix = (a: Vec3, p: number, b: Vec3, q: number): Vec3 => [a[0] * p + b[0] * q, a[1] * p + b[1] * q, a[2] * p + b[2] * q];
  return { right: mix(right, cr, up, sr), up: mix(up, cr, right, -sr), forward: [sy * cp, sp, -cy * cp] };
}

/** The camera of a scene; the server fills in every field. */
export function cameraFromScene(scene: Record<string, unknown>): CameraState {
  const camera = (scene["camera"] ?? {}) as Partial<CameraState>;
  const { position = [0, 6, 0], yaw = 0, pitch = -0.15, roll = 0, fov = 0.8727 } = camera;
  return { position: [position[0], position[1], position[2]], yaw, pitch, roll, fov };
}

const MAX_PITCH = 1.5; // Less than vertical, where yaw would only roll the picture
const MAX_HEIGHT = 1e5;
const FOV = [0.1, 2.0] as const;

const clamp = (x: number, low: number, high: number) => Math.min(high, Math.max(low, x));

/** Yaw in [−π, π], the server's range. */
const wrapAngle = (yaw: number) => yaw - 2 * Math.PI * Math.round(yaw / (2 * Math.PI));

/** Clamps to the scene's range and to the least height. */
const clampPosition = ([x, y, z]: Vec3, lowest: number): Vec3 => [clamp(x, -1e7, 1e7), clamp(y, lowest, MAX_HEIGHT), clamp(z, -1e7, 1e7)];

/** Rotates about the eye. */
export function look(camera: CameraState, yaw: number, pitch: number): CameraState {
  return { ...camera, yaw: wrapAngle(camera.yaw + yaw), pitch: clamp(camera.pitch + pitch, -MAX_PITCH, MAX_PITCH) };
}

export function move(camera: CameraState, right: number, up: number, forward: number, lowest: number): CameraState {
  const axes = basis({ ...camera, roll: 0 });
  const position = camera.position.map(
    (c, i) => c + (axes.right[i] ?? 0) * right + (axes.forward[i] ?? 0) * forward + (i === 1 ? up : 0),
  ) as unknown as Vec3;
  return { ...camera, position: clampPosition(position, lowest) };
}

/** `distance`: from the eye, m. */
export interface Pivot { point: Vec3; distance: number; }

/** Centre of an orbit: where the view meets still water, at a limited distance. */
export function pivot(camera: CameraState): Pivot {
  const { forward } = basis(camera);
  const reach = forward[1] < 0 ? camera.position[1] / -forward[1] : Infinity;
  const distance = clamp(reach, 2, Math.max(8, 8 * camera.position[1]));
  return { point: camera.position.map((c, i) => c + (forward[i] ?? 0) * distance) as unknown as Vec3, distance };
}

/** Rotates about a point that is fixed in the picture. */
export function orbit(camera: CameraState, about: Pivot, yaw: number, pitch: number, lowest: number): CameraState {
  // Greatest pitch at which the eye is not below `lowest`.
  const maxPitch = Math.asin(clamp((about.point[1] - lowest) / about.distance, -1, 1));
  const targetPitch = clamp(camera.pitch + pitch, -MAX_PITCH, MAX_PITCH);
  const rotated = { ...camera, yaw: wrapAngle(camera.yaw + yaw), pitch: Math.min(targetPitch, Math.max(maxPitch, camera.pitch)) };
  const { forward } = basis(rotated);
  const position = about.point.map((c, i) => c - (forward[i] ?? 0) * about.distance) as unknown as Vec3;
  return { ...rotated, position: clampPosition(position, lowest) };
}

/** Moves toward the pivot; factor 0.5 halves the distance. */
export function zoom(camera: CameraState, factor: number, lowest: number): CameraState {
  const { distance } = pivot(camera);
  return move(camera, 0, 0, distance * (1 - factor), lowest);
}

export const scaleFov = (camera: CameraState, factor: number): CameraState => ({ ...camera, fov: clamp(camera.fov * factor, FOV[0], FOV[1]) });
