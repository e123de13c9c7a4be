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

/** t at the middle of each texel of a part of the mask, row by row. */
export function foamTextures(texture: Uint8Array, columns: number, rows: number): Float32Array<ArrayBuffer> {
  return Float32Array.from({ length: columns * rows }, (_, i) => foamTexture(texture, (i % columns) + 0.5, Math.floor(i / columns) + 0.5));
}

/** t at a place of the mask, texels; bilinear. */
function foamTexture(texture: Uint8Array, x: number, y: number): number {
  const [u, v] = [(x / TILE) * SIDE - 0.5, (y / TILE) * SIDE - 0.5];
  const [i, j] = [Math.floor(u), Math.floor(v)];
  const at = (column: number, row: number) => (texture[(row & (SIDE - 1)) * SIDE + (column & (SIDE - 1))] ?? 0) / 255;
  const along = (row: number) => at(i, row) + (u - i) * (at(i + 1, row) - at(i, row));
  return along(j) + (v - j) * (along(j + 1) - along(j));
}
