import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { ChosenDisplay, worth } from "../../src/display/chosendisplay";
import type { DisplayEvents, Rate, ViewState } from "../../src/display/display";
import type { ServerView } from "../../src/display/serverview";
import type { Viewport } from "../../src/display/viewport";

const VIEW = {} as ViewState;

/** A display, and the two ways of drawing that it chooses from; `own`: whether this browser can draw. */
function ways(given: Rate | null = null, own = true) {
  const way = () => ({
    given: null as Rate | null,
    stalled: null as string | null,
    retryAt: 0,
    blank: false,
    presentable: true,
    ticks: 0,
    rate() { return this.given; },
    tick() { this.ticks += 1; },
    planChanged: () => undefined,
    slow: () => Promise.resolve(false),
    close: () => undefined,
    hide: () => undefined,
  });
  const [browser, server, sourceChanged] = [{ ...way(), given }, way(), vi.fn()];
  const chosen = new ChosenDisplay(own ? (browser as unknown as Viewport) : null, server as unknown as ServerView, own ? null : "No WebGL 2.", { sourceChanged } as unknown as DisplayEvents);
  return { browser, server, sourceChanged, chosen };
}

/** The same while this browser compiles its first plan; `slow`: what it seems when it is looked at, each time. */
function compiling(...slow: readonly boolean[]) {
  const all = ways();
  const looks = [...slow];
  Object.assign(all.browser, { blank: true, presentable: false, slow: vi.fn(() => Promise.resolve(looks.shift() ?? false)) });
  return all;
}

describe("what a way of drawing is worth", () => {
  it("is its pixels a second, less where it stutters or is a smear", () => {
    expect(worth({ fps: 60, scale: 1 })).toBe(60);
    expect(worth({ fps: 8, scale: 0.5 })).toBe(2);
    expect(worth({ fps: 4, scale: 0.5 })).toBe(0.5);
    expect(worth({ fps: 8, scale: 0.2 })).toBeCloseTo(0.16);
  });

  it("is nothing where it is no moving picture, or not measured", () => {
    for (const rate of [{ fps: 2, scale: 1 }, { fps: 60, scale: 0.1 }, null]) expect(worth(rate)).toBe(0);
  });
});

describe("who draws", () => {
  beforeEach(() => vi.useFakeTimers({ toFake: ["performance"] }));
  afterEach(() => vi.useRealTimers());

  const run = (display: ChosenDisplay, milliseconds: number, moving = true) => {
    for (let t = 0; t < milliseconds; t += 100) {
      display.tick(performance.now(), VIEW, moving);
      vi.advanceTimersByTime(100);
    }
  };

  it("is the server, with the reason, where the browser cannot", () => {
    expect(ways(null, false).chosen).toMatchObject({ source: "server", why: "The server draws the frames. No WebGL 2." });
  });

  it("is the browser while it is not measured, and where it gives a good picture", () => {
    const { browser, sourceChanged, chosen } = ways();
    run(chosen, 5000);
    browser.given = { fps: 9, scale: 0.45 };
    run(chosen, 5000);
    expect(chosen.source).toBe("browser");
    expect(sourceChanged).not.toHaveBeenCalled();
  });

  it("is the server at once where the browser gives no moving picture, and after a time where it gives a poor one", () => {
    const still = ways({ fps: 1, scale: 0.1 }).chosen;
    expect(still.presentable).toBe(false);
    run(still, 100);
    expect(still.source).toBe("server");
    const { browser, chosen } = ways();
    run(chosen, 2000);
    browser.given = { fps: 6, scale: 0.3 };
    run(chosen, 1000);
    expect(chosen.source).toBe("browser");
    run(chosen, 1500);
    expect(chosen.source).toBe("server");
  });

  it("is the browser again where the server gives less, and the server is not tried at once", () => {
    const { server, chosen } = ways({ fps: 6, scale: 0.3 });
    server.given = { fps: 3, scale: 0.35 };
    vi.advanceTimersByTime(5000);
    run(chosen, 300);
    expect(chosen.source).toBe("browser");
    run(chosen, 30_000);
    expect(chosen.source).toBe("browser");
  });

  it("is the browser where all streams are taken, unless it gives no moving picture", () => {
    for (const [fps, source] of [[6, "browser"], [1, "server"]] as const) {
      const { server, chosen } = ways({ fps, scale: 0.3 });
      Object.assign(server, { stalled: "all streams are taken", retryAt: 60_000 });
      vi.advanceTimersByTime(5000);
      run(chosen, 300);
      expect(chosen.source).toBe(source);
    }
  });

  it("is the server while the browser compiles for long, until its picture is good", () => {
    const { browser, server, chosen } = compiling();
    run(chosen, 1000);
    expect(chosen.source).toBe("browser");
    run(chosen, 1000);
    expect(chosen).toMatchObject({ source: "server", presentable: true, bridged: true });
    Object.assign(browser, { blank: false });
    run(chosen, 300);
    expect(chosen.source).toBe("server");
    Object.assign(browser, { presentable: true, given: { fps: 60, scale: 1 } });
    const drawn = server.ticks;
    run(chosen, 300);
    expect(chosen.source).toBe("browser");
    expect(server.ticks).toBe(drawn);
  });

  it("is the server from the first picture on where the browser is slow", async () => {
    const { browser, server, sourceChanged, chosen } = compiling(true, true);
    await Promise.all([chosen.decide(true), chosen.decide(true)]);
    expect(chosen).toMatchObject({ source: "server", why: "The server draws the frames: this browser would draw fewer pixels a second." });
    expect(sourceChanged).toHaveBeenCalledOnce();
    server.given = { fps: 4, scale: 0.4 };
    for (let look = 0; look < 3; look++) {
      run(chosen, 10_000);
      await Promise.resolve();
    }
    expect(chosen.source).toBe("server");
    expect(browser.slow).toHaveBeenCalledTimes(2);
    expect(browser.ticks).toBe(0);
  });

  it("is the browser where it only seemed slow while the page opened", async () => {
    const { chosen, server } = compiling(true, false);
    await chosen.decide(true);
    server.given = { fps: 12, scale: 0.7 };
    run(chosen, 4000);
    await Promise.resolve();
    expect(chosen.source).toBe("server");
    run(chosen, 2000);
    await Promise.resolve();
    expect(chosen.source).toBe("browser");
  });

  it("is a slow browser where the server gives no moving picture, or all streams are taken", async () => {
    for (const given of [{ given: { fps: 1, scale: 0.4 } }, { stalled: "all streams are taken", retryAt: 60_000 }]) {
      const { chosen, server } = compiling(true, true);
      await chosen.decide(true);
      Object.assign(server, given);
      run(chosen, 200);
      expect(chosen.source).toBe("browser");
    }
  });

  it("is a slow browser where nothing moves, or the user wishes so", async () => {
    const still = compiling(true).chosen;
    await still.decide(false);
    expect(still.source).toBe("browser");
    const { chosen } = compiling(true);
    chosen.choose("browser");
    await chosen.decide(true);
    expect(chosen.source).toBe("browser");
  });

  it("is the browser where it is not slow, and what draws already is not looked at", async () => {
    const { browser, chosen } = compiling(false);
    await chosen.decide(true);
    expect(chosen.source).toBe("browser");
    const drawing = ways();
    Object.assign(drawing.browser, { slow: vi.fn(() => Promise.resolve(true)) });
    await drawing.chosen.decide(true);
    expect(drawing.browser.slow).not.toHaveBeenCalled();
    expect(browser.slow).toHaveBeenCalledOnce();
  });

  it("is the browser where the user wishes so while it compiles", () => {
    const { server, chosen } = compiling();
    run(chosen, 2000);
    expect(chosen.source).toBe("server");
    const drawn = server.ticks;
    chosen.choose("browser");
    run(chosen, 2000);
    expect(chosen).toMatchObject({ source: "browser", why: "This browser draws, as you chose." });
    expect(server.ticks).toBe(drawn);
  });

  it("is the browser under its still while nothing moves", () => {
    const { chosen } = compiling();
    run(chosen, 5000, false);
    expect(chosen.source).toBe("browser");
  });

  it("is whom the user wishes", () => {
    const { chosen } = ways({ fps: 1, scale: 0.1 });
    chosen.choose("browser");
    run(chosen, 5000);
    expect(chosen).toMatchObject({ source: "browser", why: "This browser draws, as you chose." });
    chosen.choose("server");
    expect(chosen).toMatchObject({ source: "server", why: "The server draws the frames, as you chose." });
  });
});
