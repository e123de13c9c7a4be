import { describe, expect, it } from "vitest";
import { decode, encode, type LinkState } from "../../src/selection/url";

const full: LinkState = {
  preset: "default",
  changes: [
    ["/foam/look", "halftone"],
    ["/waves/0/amplitude", 0.1 + 0.2],
    ["/light", null],
    ["/water/ripples", undefined],
    ["/foam/saturation", [{ source: "height", base: 0.3 }]],
    ["/name", "a&b=c#d ~%20 λ \"quoted\""],
  ],
  touches: [
    { x: -3.25, z: 1 / 3, time: 12.5, strength: 0.025 },
    { x: 1e7, z: -1e7, time: -1e9, strength: 0.5 },
  ],
  quality: "high",
  time: -1234567.0000001,
  paused: true,
  speed: 0.25,
  camera: { position: [1 / 3, 6, -1e7], yaw: -0.1, pitch: 1e-17, roll: 0, fov: 0.8727 },
  split: { field: "/foam/look", left: "textured", right: "filtered", at: 0.25 },
  draw: "server",
  scale: 0.35,
  accuracy: true,
  surface: "take",
};

describe("a link", () => {
  it.each(["high", '{"surface":{"steps":48}}'])("restores everything, to the last bit, after the browser's own parsing: quality %s", (quality) => {
    const url = new URL(`http://127.0.0.1/#${encode({ ...full, quality })}`);
    expect(decode(url.hash)).toEqual({ ...full, quality });
  });

  it("stays under 2 kB: the oldest touches are dropped, never the newest", () => {
    const touches = Array.from({ length: 24 }, (_, i) => ({ x: -1234567.89 - i, z: 1234567.01 + i, time: 123456789.12 + i, strength: 0.025 }));
    const long = { ...full, changes: [["/name", "x".repeat(900)] as const], touches };
    const text = encode(long);
    const kept = decode(`#${text}`).touches ?? [];
    expect(new TextEncoder().encode(text).length).toBeLessThanOrEqual(2000);
    expect(kept.length).toBeGreaterThan(10);
    expect(kept.length).toBeLessThan(24);
    expect(kept).toEqual(touches.slice(-kept.length));
    expect(encode({ ...long, touches: touches.slice(-kept.length - 1) })).toBe(text);
  });

  it("holds as many touches as a drag makes", () => {
    const touches = Array.from({ length: 24 }, (_, i) => ({ x: -12.34 - i, z: 23.45 - i, time: 1234.56 + i, strength: 0.025 }));
    expect(decode(`#${encode({ ...full, touches })}`).touches).toEqual(touches);
  });

  it.each(["#touches=", "#touches=1,2,3", "#touches=a,b,c,d~,,,", "#touches=1,2,3,4,5"])("without a touch that can be read has none: %s", (fragment) => {
    expect(decode(fragment).touches).toBeNull();
  });

  it("is short where nothing was changed", () => {
    const plain = { ...full, changes: [], touches: null, quality: null, time: null, paused: null, speed: 1, camera: null, split: null, scale: null, draw: null, accuracy: null, surface: null };
    expect(encode(plain)).toBe("preset=default");
    expect(decode("#preset=default")).toEqual({ ...plain, speed: null });
  });

  it.each(["", "#", "#time=soon&camera=1,2&scene={&split=a&scale=0", "#camera=1,2,3,4,5,6,x", "#scene=%E0%A4%A", "#=1&&"])(
    "that is broken gives nothing: %s",
    (fragment) => {
      const { changes, ...rest } = decode(fragment);
      expect(changes).toEqual([]);
      expect(Object.values(rest).every((value) => value === null)).toBe(true);
    },
  );
});
