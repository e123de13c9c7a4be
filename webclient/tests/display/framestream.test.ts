import { expect, test, vi } from "vitest";
import type { Api, StreamView } from "../../src/api";
import { FrameStream } from "../../src/display/serverview";

const VIEW = { time: 0, width: 16, height: 16 } as StreamView;

test("a stream that is closed gives up its frames before the server is told: none is asked for after its end", async () => {
  const asked: string[] = [];
  const stream = new FrameStream({
    openStream: () => (asked.push("open"), Promise.resolve({ id: "a", lease: 10 })),
    streamFrame: (id: string, _: StreamView, signal: AbortSignal) =>
      new Promise((_taken, fail) => {
        asked.push(`frame of ${id}`);
        signal.addEventListener("abort", () => {
          asked.push("given up");
          fail(signal.reason as Error);
        });
      }),
    closeStream: (id: string) => asked.push(`close ${id}`),
  } as unknown as Api);

  const early = stream.frame(null, "fast", VIEW);
  stream.close();
  expect(await early).toBeNull();
  expect(asked).toEqual(["open", "close a"]);

  asked.length = 0;
  const begun = stream.frame(null, "fast", VIEW);
  await new Promise((resolve) => setTimeout(resolve));
  stream.close();
  expect(await begun).toBeNull();
  expect(asked).toEqual(["open", "frame of a", "given up", "close a"]);
});

test("a stream that has ended, or that is closed, gives its place back before another is opened", async () => {
  vi.useFakeTimers();
  const asked: string[] = [];
  let [opened, told] = [0, (): void => undefined];
  const stream = new FrameStream({
    openStream: () => (asked.push("open"), Promise.resolve({ id: `${++opened}`, lease: 3 })),
    streamFrame: (id: string) => (asked.push(`frame of ${id}`), Promise.resolve(new Blob())),
    closeStream: (id: string) => new Promise<void>((resolve) => ((told = resolve), asked.push(`close ${id}`))),
  } as unknown as Api);
  const frame = () => stream.frame(null, "fast", VIEW);
  await frame();
  vi.advanceTimersByTime(2000);
  await frame();
  vi.advanceTimersByTime(2000);
  await frame();
  expect(asked.splice(0)).toEqual(["open", "frame of 1", "frame of 1", "frame of 1"]);

  vi.advanceTimersByTime(2900);
  const other = frame();
  await vi.advanceTimersByTimeAsync(50);
  expect(asked).toEqual(["close 1"]);
  told();
  await other;
  expect(asked.splice(0)).toEqual(["close 1", "open", "frame of 2"]);

  stream.close();
  stream.close();
  const last = frame();
  await vi.advanceTimersByTimeAsync(50);
  told();
  await last;
  expect(asked).toEqual(["close 2", "open", "frame of 3"]);
  vi.useRealTimers();
});
