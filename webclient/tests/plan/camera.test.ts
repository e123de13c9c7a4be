import { describe, expect, it } from "vitest";
import { basis, type CameraState, look, move, orbit, pivot, type Vec3, zoom } from "../../src/camera/state";

const start: CameraState = { position: [3, 6, -2], yaw: 0.7, pitch: -0.4, roll: 0, fov: 0.9 };
const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

describe("axes", () => {
  it.each([[0, 0, 0], [0.7, -0.4, 0], [-2, Math.PI / 2, 0.3], [3, -Math.PI / 2, -1]])("are at right angles at yaw %f, pitch %f, roll %f", (yaw, pitch, roll) => {
    const { right, up, forward } = basis({ ...start, yaw, pitch, roll });
    for (const [a, b] of [[right, up], [right, forward], [up, forward]] as const) expect(dot(a, b)).toBeCloseTo(0, 12);
    for (const a of [right, up, forward]) expect(dot(a, a)).toBeCloseTo(1, 12);
  });

  it("look toward −z at rest, and toward +x after a positive yaw", () => {
    expect(basis({ ...start, yaw: 0, pitch: 0 }).forward).toEqual([0, 0, -1]);
    expect(basis({ ...start, yaw: Math.PI / 2, pitch: 0 }).forward[0]).toBeCloseTo(1, 12);
  });
});

describe("motion", () => {
  it("keeps yaw within half a turn however often it turns", () => {
    let camera = start;
    for (let i = 0; i < 100; i++) camera = look(camera, 0.5, 0);
    expect(Math.abs(camera.yaw)).toBeLessThanOrEqual(Math.PI);
    expect(Math.sin(camera.yaw)).toBeCloseTo(Math.sin(start.yaw + 50), 9);
  });

  it("never dives", () => {
    expect(move(start, 0, -100, 0, 0.5).position[1]).toBe(0.5);
    expect(zoom(start, 0, 0.5).position[1]).toBeGreaterThanOrEqual(0.5);
    const about = pivot(start);
    expect(orbit(start, about, 0, 3, 0.5).position[1]).toBeGreaterThanOrEqual(0.5);
  });

  it("orbits at a constant distance, with its pivot in the middle", () => {
    const about = pivot(start);
    const turned = orbit(start, about, 1.1, -0.2, 0.5);
    const distance = Math.hypot(...turned.position.map((c, i) => c - (about.point[i] ?? 0)));
    expect(distance).toBeCloseTo(about.distance, 9);
    const { forward } = basis(turned);
    about.point.forEach((c, i) => expect((turned.position[i] ?? 0) + (forward[i] ?? 0) * distance).toBeCloseTo(c, 9));
  });

  it("halves the way to the pivot", () => {
    const before = pivot(start);
    expect(pivot(zoom(start, 0.5, 0)).distance).toBeCloseTo(before.distance / 2, 9);
  });

  it("stays where a scene may put it", () => {
    expect(move({ ...start, position: [9.99999e6, 6, 0] }, 0, 0, 1e5, 0).position[0]).toBeLessThanOrEqual(1e7);
  });
});
