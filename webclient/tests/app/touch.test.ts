import { describe, expect, it } from "vitest";
import { CameraControls, type PointerTool } from "../../src/camera/controls";
import type { CameraState } from "../../src/camera/state";
import { appended, decodeTouches, encodeTouches, pickWater, toJson, touchAt, TOUCHES_MOST, touchesOf, train, type WaterPlace } from "../../src/touch/touches";
import { golden as read } from "../golden";

const golden = read("picks") as { camera: CameraState; width: number; height: number; picks: { x: number; y: number; place: WaterPlace | null }[] }[];

describe("the place of water that a pixel shows is the reference's", () => {
  it.each(golden.map((vector, i) => [i, vector] as const))("view %i", (_, { camera, width, height, picks }) => {
    for (const { x, y, place } of picks) {
      const found = pickWater(camera, x, y, width, height);
      if (place === null || found === null) expect(found).toEqual(place);
      else for (const part of ["x", "z", "distance"] as const) expect(Math.abs(found[part] - place[part])).toBeLessThan(1e-9 * (Math.abs(place[part]) + 1));
    }
  });

  it("is there and is not, by view", () => {
    const places = golden.flatMap(({ picks }) => picks.map(({ place }) => place !== null));
    expect(places.filter((there) => there).length).toBeGreaterThan(20);
    expect(places.filter((there) => !there).length).toBeGreaterThan(5);
  });
});

describe("touches", () => {
  const near: WaterPlace = { x: 1.23456, z: -6.54321, distance: 7 };

  it("are of a few centimetres near by, and stronger far away", () => {
    expect(touchAt(near, 3.14159)).toEqual({ x: 1.23, z: -6.54, time: 3.14, strength: 0.02 });
    expect(touchAt({ ...near, distance: 60 }, 0).strength).toBe(0.15);
    expect(touchAt({ ...near, distance: 1500 }, 0).strength).toBe(0.5);
  });

  it("of a drag lie at equal distances along its way", () => {
    const last = touchAt({ x: 0, z: 0, distance: 5 }, 0);
    const places = train(last, { x: 1.2, z: 1.6, distance: 5 });
    expect(places.map(({ x, z }) => Math.hypot(x, z))).toEqual([0.56, 1.12, 1.68].map((d) => expect.closeTo(d, 9) as number));
    expect(places.every(({ x, z }) => Math.abs(4 * x - 3 * z) < 1e-9)).toBe(true);
    expect(train(last, { x: 0.1, z: 0.1, distance: 5 })).toEqual([]);
    expect(train(last, { x: 1000, z: 0, distance: 5 }).length).toBeLessThan(10);
  });

  it("make room for new ones", () => {
    const all = Array.from({ length: TOUCHES_MOST }, (_, i) => touchAt(near, i));
    const more = appended(all, [touchAt(near, 99)]);
    expect(more).toHaveLength(TOUCHES_MOST);
    expect(more[0]?.time).toBe(1);
    expect(more.at(-1)?.time).toBe(99);
  });

  it("are read from scenes and links as they were written", () => {
    const some = [touchAt(near, 1), touchAt({ ...near, distance: 90 }, -2.5)];
    expect(touchesOf({ touches: toJson(some) })).toEqual(some);
    expect(touchesOf({ touches: [{ place: [1] }, null, 3] })).toEqual([]);
    expect(touchesOf({})).toEqual([]);
    expect(decodeTouches(encodeTouches(some))).toEqual(some);
  });
});

/** An element of 400 × 300 that takes events and nothing else. */
class Surface extends EventTarget {
  clientWidth = 400;
  clientHeight = 300;
  setPointerCapture = () => undefined;

  send(type: string, pointer: Partial<PointerEvent>): void {
    const event = { pointerId: 1, pointerType: "mouse", button: 0, buttons: 1, shiftKey: false, clientX: 200, clientY: 150, ...pointer };
    this.dispatchEvent(Object.assign(new Event(type), event));
  }

  drag(pointer: Partial<PointerEvent>): void {
    this.send("pointerdown", pointer);
    this.send("pointermove", { ...pointer, clientX: 240, clientY: 170 });
    this.send("pointerup", { ...pointer, clientX: 240, clientY: 170, buttons: 0 });
  }
}

function rig(touches: boolean, takes = true) {
  const surface = new Surface();
  const start: CameraState = { position: [0, 6, 0], yaw: 0, pitch: -0.3, roll: 0, fov: 0.9 };
  const controls = new CameraControls(surface as unknown as HTMLElement, start, false);
  const log: string[] = [];
  const tool: PointerTool = {
    start: () => (log.push("start"), takes),
    move: () => log.push("move"),
    end: () => log.push("end"),
    cancel: () => log.push("cancel"),
  };
  controls.tool = touches ? tool : null;
  return { surface, controls, log, moved: () => (controls.step(0.02), JSON.stringify(controls.camera) !== JSON.stringify(start)) };
}

describe("the main pointer", () => {
  it.each(["mouse", "touch", "pen"])("touches the water with a %s", (pointerType) => {
    const { surface, log, moved } = rig(true);
    surface.drag({ pointerType });
    expect(log).toEqual(["start", "move", "end"]);
    expect(moved()).toBe(false);
  });

  it("moves the camera where that was chosen, and where there is no water", () => {
    const chosen = rig(false);
    chosen.surface.drag({});
    expect(chosen.moved()).toBe(true);
    const sky = rig(true, false);
    sky.surface.drag({});
    expect(sky.log).toEqual(["start"]);
    expect(sky.moved()).toBe(true);
  });

  it.each([
    ["the right button", { button: 2, buttons: 2 }],
    ["the middle button", { button: 1, buttons: 4 }],
    ["shift", { shiftKey: true }],
  ])("is not %s, which moves the camera", (_, pointer) => {
    const { surface, log, moved } = rig(true);
    surface.drag(pointer);
    expect(log).toEqual([]);
    expect(moved()).toBe(true);
  });

  it("rotates with the right button while the left touches, and pans with it else", () => {
    const touching = rig(true);
    touching.surface.drag({ button: 2, buttons: 2 });
    touching.moved();
    expect(touching.controls.camera.yaw).not.toBe(0);
    const moving = rig(false);
    moving.surface.drag({ button: 2, buttons: 2 });
    moving.moved();
    expect(moving.controls.camera.yaw).toBe(0);
    expect(moving.controls.camera.position[0]).not.toBe(0);
  });

  it("gives way to a second finger: two turn and zoom", () => {
    const { surface, controls, log, moved } = rig(true);
    surface.send("pointerdown", { pointerType: "touch", clientX: 150 });
    surface.send("pointerdown", { pointerType: "touch", pointerId: 2, clientX: 250 });
    surface.send("pointermove", { pointerType: "touch", pointerId: 2, clientX: 330, clientY: 180 });
    expect(log).toEqual(["start", "cancel"]);
    expect(moved()).toBe(true);
    expect(controls.camera.yaw).not.toBe(0);
    expect(controls.camera.position[2]).toBeLessThan(0);
  });

  it.each([3, 397])("leaves a swipe from the edge at %i px to the browser", (clientX) => {
    for (const touches of [true, false]) {
      const { surface, log, moved } = rig(touches);
      surface.drag({ pointerType: "touch", clientX });
      expect(log).toEqual([]);
      expect(moved()).toBe(false);
    }
    const mouse = rig(true);
    mouse.surface.drag({ clientX });
    expect(mouse.log).toEqual(["start", "move", "end"]);
  });

  it("that the browser takes over raises nothing", () => {
    const { surface, log } = rig(true);
    surface.send("pointerdown", { pointerType: "touch" });
    surface.send("pointercancel", { pointerType: "touch" });
    expect(log).toEqual(["start", "cancel"]);
  });
});
