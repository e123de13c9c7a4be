import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { drawsSlowly } from "../../src/gl/speed";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

/** A driver whose draws take so long, ms, one after the other: the first one of them, as it compiles, longer. */
function driver(draw: number, compiles: number): WebGL2RenderingContext {
  let [free, drawn] = [0, 0];
  const own: Record<string, unknown> = {
    SIGNALED: 1,
    isContextLost: () => false,
    drawArrays: () => (free = Math.max(free, performance.now()) + draw + (drawn++ === 0 ? compiles : 0)),
    fenceSync: () => free,
    getSyncParameter: (fence: number) => Number(performance.now() >= fence),
  };
  return new Proxy({}, { get: (_, name: string) => own[name] ?? (() => ({})) }) as WebGL2RenderingContext;
}

it.each([
  ["a GPU", 0.5, 20, false],
  ["a small GPU", 12, 150, false],
  ["a GPU whose compiler takes half a second", 4, 500, false],
  ["two fast cores", 32, 40, true],
  ["a slow processor", 160, 200, true],
])("%s draws slowly: draws of %d ms, %d to compile, %s", async (_, draw, compiles, slow) => {
  const said = drawsSlowly(driver(draw, compiles));
  await vi.advanceTimersByTimeAsync(3000);
  expect(await said).toBe(slow);
});
