/** Options of fields that the server lists, requested once each. */
import type { Choice } from "../api";

export class ListedOptions {
  private readonly lists = new Map<string, readonly Choice[]>();

  /** `arrived`: called when a list is there. A list that could not be loaded is requested again when it is asked for. */
  constructor(
    private readonly load: (url: string) => Promise<readonly Choice[]>,
    private readonly arrived: () => void,
    private readonly failed: (error: unknown) => void,
  ) {}

  /** The options at an address; empty until they arrive. */
  from(url: string): readonly Choice[] {
    const known = this.lists.get(url);
    if (known) return known;
    this.lists.set(url, []);
    this.load(url).then(
      (options) => {
        this.lists.set(url, options);
        this.arrived();
      },
      (error: unknown) => {
        this.lists.delete(url);
        this.failed(error);
      },
    );
    return [];
  }
}
