/** Shares GPU resources by key, and keeps the last few unused ones, so that going back to a look costs nothing. */

interface Entry<V> {
  key: string;
  value: V;
  users: number;
}

/** A share in a pooled resource. */
export interface Lease<V> {
  readonly value: V;
  /** Gives the share back; once is enough, more do nothing. */
  release(): void;
  /** Takes a resource that turned out broken away from everyone. */
  discard(): void;
}

export class Pool<V> {
  private readonly entries = new Map<string, Entry<V>>();

  /** `spare`: how many unused resources are kept. */
  constructor(
    private readonly destroy: (value: V) => void,
    private readonly spare: number,
  ) {}

  get size(): number {
    return this.entries.size;
  }

  /** The resource under `key`, made if it is not there. */
  acquire(key: string, make: () => V): Lease<V> {
    const entry = this.entries.get(key) ?? { key, value: make(), users: 0 };
    // The map's order is the order of last use, so the entries that go first are found first.
    this.entries.delete(key);
    this.entries.set(key, entry);
    entry.users += 1;
    let held = true;
    const release = () => {
      if (!held) return;
      held = false;
      entry.users -= 1;
      this.trim();
    };
    const discard = () => {
      if (this.entries.get(key) === entry) {
        this.entries.delete(key);
        this.destroy(entry.value);
      }
      release();
    };
    return { value: entry.value, release, discard };
  }

  private trim(): void {
    const unused = [...this.entries.values()].filter(({ users }) => users === 0);
    for (const { key, value } of unused.slice(0, Math.max(0, unused.length - this.spare))) {
      this.entries.delete(key);
      this.destroy(value);
    }
  }
}
