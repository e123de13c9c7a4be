/** Shares GPU resources by key, and keeps the most recently used ones after their last user. */

/** A reference to a pooled resource. */
export interface Lease<V> {
  readonly value: V;
  /** Releases the reference; further calls have no effect. */
  release(): void;
  /** Removes a resource that failed to load. */
  discard(): void;
}

export class Pool<V> {
  private readonly entries = new Map<string, { value: V; users: number }>();

  /** `spare`: number of unused resources kept. */
  constructor(private readonly destroy: (value: V) => void, private readonly spare: number) {}

  get size(): number {
    return this.entries.size;
  }

  acquire(key: string, make: () => V): Lease<V> {
    const entry = this.entries.get(key) ?? { value: make(), users: 0 };
    // Map order is order of last use: `trim` removes from the front.
    this.entries.delete(key);
    this.entries.set(key, entry);
    entry.users += 1;
    let released = false;
    const release = () => {
      if (released) return;
      released = true;
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
    const unused = [...this.entries].filter(([, { users }]) => users === 0);
    for (const [key, { value }] of unused.slice(0, Math.max(0, unused.length - this.spare))) {
      this.entries.delete(key);
      this.destroy(value);
    }
  }
}
