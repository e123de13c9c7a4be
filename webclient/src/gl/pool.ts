/** Shares GPU resources by key, and keeps the last few unused ones, so that going back to a look costs nothing. */

interface Entry<V> {
  value: V;
  users: number;
}

export class Pool<V> {
  private readonly entries = new Map<string, Entry<V>>();

  constructor(
    private readonly destroy: (value: V) => void,
    private readonly spare: number,
  ) {}

  get size(): number {
    return this.entries.size;
  }

  /** The resource under `key`, made if it is not there; each call needs one `release`. */
  acquire(key: string, make: () => V): V {
    let entry = this.entries.get(key);
    if (entry === undefined) {
      entry = { value: make(), users: 0 };
    } else {
      this.entries.delete(key);
    }
    // Map order is the order of last use: the oldest unused entry is the first found.
    this.entries.set(key, entry);
    entry.users += 1;
    return entry.value;
  }

  release(key: string): void {
    const entry = this.entries.get(key);
    if (entry === undefined) return;
    entry.users -= 1;
    let unused = [...this.entries.values()].filter((e) => e.users <= 0).length;
    for (const [oldKey, old] of this.entries) {
      if (unused <= this.spare) break;
      if (old.users > 0) continue;
      this.entries.delete(oldKey);
      this.destroy(old.value);
      unused -= 1;
    }
  }

  /** Drops one entry whatever its users, for a resource that turned out broken. */
  evict(key: string): void {
    const entry = this.entries.get(key);
    if (entry === undefined) return;
    this.entries.delete(key);
    this.destroy(entry.value);
  }

  /** Forgets everything without touching the GPU: the context that held it is gone. */
  forget(): void {
    this.entries.clear();
  }
}
