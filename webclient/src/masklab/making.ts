/** A mask that the server makes in the background, followed by its server-sent events. */

/** Reads events until the mask is there; `told` hears the share that is done, 0 to 1. Throws if they end before. */
export async function follow(response: Response, told: (share: number) => void): Promise<void> {
  if (response.body === null) throw new Error("The server sent no events.");
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) throw new Error("The server stopped making the mask.");
    const events = (text + value).split("\n\n");
    text = events.pop() ?? "";
    for (const event of events) {
      const [, name, data] = /^event: (\w+)\ndata: (.*)$/.exec(event) ?? [];
      if (name === "progress") told(Number(data));
      if (name === "done") {
        await reader.cancel();
        return;
      }
    }
  }
}
