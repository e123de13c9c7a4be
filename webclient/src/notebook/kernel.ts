/** The widget's model in the notebook, and requests to Python over its connection. */
import type { JsonObject } from "../scene/json";

/** What anywidget passes to a widget's page. */
export interface Model {
  get(name: string): unknown;
  set(name: string, value: unknown): void;
  save_changes(): void;
  on(event: string, listener: (...values: never[]) => void): void;
  off(event: string, listener: (...values: never[]) => void): void;
  send(content: JsonObject): void;
}

interface Answer { value: unknown; parts: readonly DataView[]; }

/** Requests of one view; answers to other views of the same model are ignored. */
export class Kernel {
  private readonly waiting = new Map<string, { resolve: (answer: Answer) => void; reject: (error: Error) => void }>();
  private readonly name = crypto.getRandomValues(new Uint32Array(4)).join("-");
  private count = 0;

  constructor(private readonly model: Model) {
    model.on("msg:custom", this.receive);
  }

  ask(kind: string, fields: JsonObject = {}): Promise<Answer> {
    const id = `${this.name}/${++this.count}`;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.model.send({ id, kind, ...fields });
    });
  }

  dispose(): void {
    this.model.off("msg:custom", this.receive);
    this.waiting.clear();
  }

  private readonly receive = ({ id, value, error }: { id: string; value?: unknown; error?: string }, parts: readonly DataView[] = []): void => {
    const request = this.waiting.get(id);
    if (request === undefined) return;
    this.waiting.delete(id);
    if (error === undefined) request.resolve({ value, parts });
    else request.reject(new Error(error));
  };
}
