/** Reads NumPy's .npy format: little-endian float32 in C order. */

export interface Picture {
  width: number;
  height: number;
  /** RGBA, rows from the top. */
  pixels: Float32Array;
}

const MAGIC = [0x93, 0x4e, 0x55, 0x4d, 0x50, 0x59];

/** Reads a (height, width, 4) array; throws an `Error` for any other. */
export function readPicture(buffer: ArrayBuffer): Picture {
  const bytes = new Uint8Array(buffer);
  if (!MAGIC.every((byte, i) => bytes[i] === byte)) throw new Error("The reference picture is not a .npy file.");
  const view = new DataView(buffer);
  const longHeader = (bytes[6] ?? 1) > 1;
  const start = longHeader ? 12 : 10;
  if (buffer.byteLength < start) throw new Error("The reference picture is truncated.");
  const length = longHeader ? view.getUint32(8, true) : view.getUint16(8, true);
  const header = new TextDecoder("latin1").decode(bytes.subarray(start, start + length));
  const type = /'descr':\s*'([^']*)'/.exec(header)?.[1];
  const shape = /'shape':\s*\(([^)]*)\)/.exec(header)?.[1]?.split(",").map((part) => part.trim()).filter(Boolean).map(Number) ?? [];
  const [height, width, channels] = shape;
  if (type !== "<f4" || !/'fortran_order':\s*False/.test(header) || shape.length !== 3 || channels !== 4 || !height || !width) {
    throw new Error(`The reference picture has type ${type ?? "unknown"} and shape (${shape.join(", ")}); required: float32 (height, width, 4).`);
  }
  const count = height * width * 4;
  const data = start + length;
  if (buffer.byteLength < data + 4 * count) throw new Error("The reference picture is truncated.");
  // Copied, since the data may not be aligned to four bytes.
  return { width, height, pixels: new Float32Array(buffer.slice(data, data + 4 * count)) };
}
