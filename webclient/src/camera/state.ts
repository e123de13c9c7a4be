/** The camera's state (float64, metres and radians) and its axes. */

export type Vec3 = readonly [number, number, number];

export interface CameraState {
  /** Eye; y relative to still water. */
  position: Vec3;
  /** Heading, from −z toward +x. */
  yaw: number;
  /** Elevation of the view. */
  pitch: number;
  roll: number;
  /** Vertical field of view. */
  fov: number;
}

export function basis({ yaw, pitch, roll }: CameraState): Record<"right" | "up" | "forward", Vec3> {
  const [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
  const right: Vec3 = [cy, 0, sy];
  const up: Vec3 = [-sy * sp, cp, cy * sp];
  const [cr, sr] = [Math.cos(roll), Math.sin(roll)];
  const mix = (a: Vec3, p: number, b: Vec3, q: number): Vec3 => [a[0] * p + b[0] * q, a[1] * p + b[1] * q, a[2] * p + b[2] * q];
  return {
    right: mix(right, cr, up, sr),
    up: mix(up, cr, right, -sr),
    forward: [sy * cp, sp, -cy * cp],
  };
}

/** The camera of a scene; the server fills in every field. */
export function cameraFromScene(scene: Record<string, unknown>): CameraState {
  const camera = (scene["camera"] ?? {}) as Partial<CameraState>;
  const { position = [0, 6, 0], yaw = 0, pitch = -0.15, roll = 0, fov = 0.8727 } = camera;
  return { position: [position[0], position[1], position[2]], yaw, pitch, roll, fov };
}
