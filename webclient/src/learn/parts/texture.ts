/** The foam texture t of equation 3 and the listing. */
import type { Api } from "../../api";

/** Side of its finest level, texels. */
const SIDE = 256;
/** Its side in texels of the mask, as in the scene of figure 7 (tiles of 2.4 m and 9 m). */
const TILE = (512 * 2.4) / 9;

let loading: Promise<Uint8Array> | null = null;

export function loadFoamTexture(api: Api): Promise<Uint8Array> {
  loading ??= api.fetch("api/textures/foam").then(async (response) => new Uint8Array(await response.arrayBuffer(), 0, SIDE * SIDE));
  loading.catch(() => (loading = null));
  return loading;
}

/** t at a texel of the mask, bilinear. */
export function foamTexture(texture: Uint8Array, x: number, y: number): number {
  const [u, v] = [(x / TILE) * SIDE - 0.5, (y / TILE) * SIDE - 0.5];
  const [i, j] = [Math.floor(u), Math.floor(v)];
  const at = (column: number, row: number) => (texture[(row & (SIDE - 1)) * SIDE + (column & (SIDE - 1))] ?? 0) / 255;
  const along = (row: number) => at(i, row) + (u - i) * (at(i + 1, row) - at(i, row));
  return along(j) + (v - j) * (along(j + 1) - along(j));
}
