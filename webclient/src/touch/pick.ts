/** Which place of still water a pixel shows: rays as the shaders' (docs/formulae.md, section 1), in float64. */
import { basis, type CameraState } from "../camera/state";

export interface WaterPlace {
  /** m */
  x: number;
  z: number;
  /** From the eye, m. */
  distance: number;
}

/** Places farther away are not touched, m: a ring there is smaller than a pixel. */
const FARTHEST = 2000;

/** The place at (x, y) of a picture of width × height, from its upper left corner; null where no water is in reach. */
export function pickWater(camera: CameraState, x: number, y: number, width: number, height: number): WaterPlace | null {
  const { right, up, forward } = basis(camera);
  const q = Math.tan(camera.fov / 2);
  const along = ((2 * x) / width - 1) * q * (width / height);
  const upward = (1 - (2 * y) / height) * q;
  const [dx, dy, dz] = [0, 1, 2].map((i) => (forward[i] ?? 0) + along * (right[i] ?? 0) + upward * (up[i] ?? 0)) as [number, number, number];
  const [eyeX, eyeY, eyeZ] = camera.position;
  // From below, the surface is above.
  const far = -eyeY / dy;
  const distance = far * Math.hypot(dx, dy, dz);
  if (!(far > 0) || distance > FARTHEST) return null;
  return { x: eyeX + far * dx, z: eyeZ + far * dz, distance };
}
