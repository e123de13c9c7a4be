/**
 * Where a picture keeps the text of its recipe: an iTXt chunk of a PNG (ISO 15948), a property in the XMP packet of a WebP
 * (ISO 16684-1), an attribute in the header of an OpenEXR file.
 *
 * The server writes all three (server/seafoam/render/encode).
 */

/** Keyword of PNG's chunk, name of OpenEXR's attribute. */
export const KEYWORD = "seafoam";
const XMP_NAMESPACE = "urn:seafoam:recipe:";
const PNG = "\x89PNG\r\n\x1a\n";
const EXR = "v/1\x01";
/** OpenEXR: bytes of its signature and version, before the first attribute. */
const EXR_HEADER = 8;
/** Greatest length of a name, bytes. */
const EXR_NAME = 255;
/** PNG: length and type before a chunk's data, and the checksum after it, bytes. */
export const BEFORE = 8;
export const AFTER = 4;

// Not a decoder: its "latin1" is windows-1252.
const latin = (bytes: Uint8Array) => String.fromCharCode(...bytes);
const utf8 = new TextDecoder();

/** The text; null if the picture has none, undefined if the file is of none of the three formats. */
export function recipeText(bytes: Uint8Array): string | null | undefined {
  const start = latin(bytes.subarray(0, 12));
  if (start.startsWith(PNG)) return inPng(bytes);
  if (start.startsWith("RIFF") && start.endsWith("WEBP")) return inWebp(bytes);
  if (start.startsWith(EXR)) return inExr(bytes);
  return undefined;
}

function inPng(bytes: Uint8Array): string | null {
  const view = viewOf(bytes);
  for (let at = PNG.length; at + BEFORE + AFTER <= bytes.length; ) {
    const end = at + BEFORE + view.getUint32(at);
    if (end + AFTER > bytes.length) return null;
    if (latin(bytes.subarray(at + 4, at + BEFORE)) === "iTXt") {
      const data = bytes.subarray(at + BEFORE, end);
      const start = latin(data.subarray(0, KEYWORD.length + 5));
      if (start === `${KEYWORD}\0\0\0\0\0`) return utf8.decode(data.subarray(KEYWORD.length + 5));
    }
    at = end + AFTER;
  }
  return null;
}

function inWebp(bytes: Uint8Array): string | null {
  const view = viewOf(bytes);
  for (let at = 12; at + 8 <= bytes.length; ) {
    const length = view.getUint32(at + 4, true);
    if (latin(bytes.subarray(at, at + 4)) === "XMP ") {
      const packet = new DOMParser().parseFromString(utf8.decode(bytes.subarray(at + 8, at + 8 + length)), "application/xml");
      return packet.getElementsByTagNameNS(XMP_NAMESPACE, "recipe")[0]?.textContent ?? null;
    }
    // Chunks begin at even places.
    at += 8 + length + (length % 2);
  }
  return null;
}

function inExr(bytes: Uint8Array): string | null {
  const view = viewOf(bytes);
  const nameAt = (at: number) => {
    const name = bytes.subarray(at, at + EXR_NAME + 1);
    return latin(name.subarray(0, Math.max(name.indexOf(0), 0)));
  };
  // Attributes up to an empty name: name, type, length, value.
  for (let at = EXR_HEADER, name = nameAt(at); name !== ""; name = nameAt(at)) {
    const type = nameAt(at + name.length + 1);
    const value = at + name.length + type.length + 6;
    if (value > bytes.length) return null;
    const end = value + view.getUint32(value - 4, true);
    if (name === KEYWORD && type === "string") return utf8.decode(bytes.subarray(value, end));
    at = end;
  }
  return null;
}

const viewOf = (bytes: Uint8Array) => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
