import { expect, test } from "vitest";
import type { Api, StreamView } from "../../src/api";
import { FrameStream } from "../../src/display/framestream";

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
