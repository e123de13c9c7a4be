import { describe, expect, it } from "vitest";
import type { CameraState } from "../../src/camera/state";
import type { FramePlan } from "../../src/generated/api";
import { drawnPasses, eyeOf } from "../../src/plan/view";
import { golden as read } from "../golden";

interface Golden {
  preset: string;
  tier: string;
  plan: Pick<FramePlan, "passes" | "top" | "trough">;
  pictures: { camera: CameraState; width: number; height: number; drawn: [number, boolean][] }[];
}

const golden = read("views") as Golden[];

describe("passes that a picture needs agree with the server's", () => {
  it.each(golden.map((vector) => [`${vector.preset}, ${vector.tier}`, vector] as const))("%s", (_, { plan, pictures }) => {
    for (const { camera, width, height, drawn } of pictures) {
      expect([...drawnPasses(plan, eyeOf(plan, camera), camera, width, height)]).toEqual(drawn);
    }
  });

  it("has pictures without water, without sky and without boats", () => {
    const drawn = golden.flatMap(({ plan, pictures }) =>
      pictures.map((picture) => new Set(picture.drawn.filter(([, shows]) => shows).map(([index]) => plan.passes[index]?.name))),
    );
    for (const name of ["surface", "sky", "boats"]) expect(drawn.some((names) => !names.has(name))).toBe(true);
  });
});
