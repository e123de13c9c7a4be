/** NumPy's file format, as far as pictures need it: little-endian float32 in C order. */

export interface Picture {
  width: number;
  height: number;
  /** RGBA, rows from the top. */
  pixels: Float32Array;
}

const MAGIC = [0x93, 0x4e, 0x55, 0x4d, 0x50, 0x59];

/** Reads a (height, width, 4) picture; throws a plain `Error` for anything else. */
export function readPicture(buffer: ArrayBuffer): Picture {
  const bytes = new Uint8Array(buffer);
  if (!MAGIC.every((byte, i) => bytes[i] === byte)) throw new Error("the reference picture is no .npy file");
  const view = new DataView(buffer);
  const long = (bytes[6] ?? 1) > 1;
  const start = long ? 12 : 10;
  if (buffer.byteLength < start) throw new Error("the reference picture is cut short");
  const length = long ? view.getUint32(8, true) : view.getUint16(8, true);
  const header = new TextDecoder("latin1").decode(bytes.subarray(start, start + length));
  const type = /'descr':\s*'([^']*)'/.exec(header)?.[1];
  const shape = /'shape':\s*\(([^)]*)\)/.exec(header)?.[1]?.split(",").map((part) => part.trim()).filter(Boolean).map(Number) ?? [];
  const [height, width, channels] = shape;
  if (type !== "<f4" || !/'fortran_order':\s*False/.test(header) || shape.length !== 3 || channels !== 4 || !height || !width) {
    throw new Error(`the reference picture is ${type ?? "of no type"} of shape (${shape.join(", ")}), not float32 (height, width, 4)`);
  }
  const count = height * width * 4;
  const data = start + length;
  if (buffer.byteLength < data + 4 * count) throw new Error("the reference picture is cut short");
  // The header may end anywhere; a Float32Array may not begin anywhere.
  return { width, height, pixels: new Float32Array(buffer.slice(data, data + 4 * count)) };
}
