import { describe, expect, it, vi } from "vitest";
import type { Capabilities } from "../../src/gl/capabilities";
import { gridData, targetSize } from "../../src/gl/resources";
import { Pool } from "../../src/gl/gpu";
import { annotate, type Program, whenReady } from "../../src/gl/program";

describe("a grid", () => {
  it("runs over [0, 1]², columns first, two triangles a cell", () => {
    const { vertices, indices } = gridData(1, 2);
    expect([...vertices]).toEqual([0, 0, 0.5, 0, 1, 0, 0, 1, 0.5, 1, 1, 1]);
    expect([...indices]).toEqual([0, 1, 3, 3, 1, 4, 1, 2, 4, 4, 2, 5]);
  });
});

describe("a target", () => {
  it("follows the picture or stands fixed", () => {
    const rest = { format: "RGBA16F", depth: false, filter: "nearest", wrap: "repeat", layers: 1 } as const;
    expect(targetSize({ ...rest, size: { rule: "viewport", scale: 2, part: 1, narrow: 1, odd: false } }, 30, 20)).toEqual([60, 40]);
    expect(targetSize({ ...rest, size: { rule: "viewport", scale: 1, part: 4, narrow: 16, odd: false } }, 30, 21)).toEqual([1, 6]);
    expect(targetSize({ ...rest, size: { rule: "viewport", scale: 1, part: 4, narrow: 3, odd: true } }, 190, 20)).toEqual([17, 5]);
    expect(targetSize({ ...rest, size: { rule: "viewport", scale: 1, part: 16, narrow: 3, odd: true } }, 20, 70)).toEqual([3, 5]);
    expect(targetSize({ ...rest, size: { rule: "fixed", width: 8, height: 4 } }, 30, 20)).toEqual([8, 4]);
  });
});

describe("a compiler's message", () => {
  const shader = { text: "", sha256: "", files: [{ path: "b.glsl", line: 40 }, { path: "a.glsl", line: 5 }] }; // prettier-ignore

  it("names the file and the line within it", () => {
    expect(annotate("ERROR: 0:42: 'x' : undeclared\0", shader)).toBe("ERROR: b.glsl:3: 'x' : undeclared");
    expect(annotate("0:7(12): error: no", shader)).toBe("a.glsl:3(12): error: no");
    expect(annotate("ERROR: 0:1: bad", shader)).toBe("ERROR: 0:1: bad");
  });
});

describe("a pool", () => {
  it("shares, keeps the last unused, and destroys the rest", () => {
    const destroy = vi.fn();
    const pool = new Pool<string>(destroy, 1);
    const first = pool.acquire("a", () => "A");
    const again = pool.acquire("a", () => "never");
    expect(again.value).toBe("A");
    first.release();
    first.release();
    again.release();
    expect(destroy).not.toHaveBeenCalled();
    pool.acquire("b", () => "B").release();
    expect(destroy).toHaveBeenCalledExactlyOnceWith("A");
    expect(pool.size).toBe(1);
  });

  it("does not hand on what is broken", () => {
    const pool = new Pool<string>(() => undefined, 9);
    pool.acquire("a", () => "broken").discard();
    expect(pool.acquire("a", () => "whole").value).toBe("whole");
  });
});

describe("waiting for the compiler", () => {
  const extensions = new Set(["KHR_parallel_shader_compile"]);
  const program = { handle: {} } as Program;
  /** `done`: whether the program is linked; `executed`: whether the driver has executed its commands. */
  const driver = (done: () => boolean, executed = done) =>
    ({
      ...{ SIGNALED: true, flush: () => undefined, isContextLost: () => false, fenceSync: () => ({}), deleteSync: () => undefined },
      ...{ getExtension: () => ({ COMPLETION_STATUS_KHR: 1 }), getProgramParameter: done, getSyncParameter: executed },
    }) as unknown as WebGL2RenderingContext;
  const never = () => false;

  it.each([["the driver says so", true], ["the commands are executed, where the driver does not say when a program is linked", false]])("ends when %s", async (_, told) => {
    let polls = 0;
    const third = () => ++polls > 2;
    const gl = told ? driver(third, never) : driver(never, third);
    const deleted = vi.spyOn(gl, "deleteSync");
    await whenReady(gl, program, { extensions: told ? extensions : new Set() } as unknown as Capabilities);
    expect(polls).toBe(3);
    expect(deleted).toHaveBeenCalledTimes(told ? 0 : 1);
  });

  it("ends even where the driver never says so", async () => {
    vi.useFakeTimers({ toFake: ["setTimeout", "performance"] });
    try {
      const waiting = whenReady(driver(never), program, { extensions } as unknown as Capabilities);
      await vi.advanceTimersByTimeAsync(60_000);
      await waiting;
    } finally {
      vi.useRealTimers();
    }
  });
});
