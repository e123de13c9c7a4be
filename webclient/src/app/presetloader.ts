/** Requests the preset that a visitor chose, by its name or by a link. */
import type { Api, Preset } from "../api";

export class PresetLoader {
  private requests = 0;

  /** `busy`: called when a preset begins or ends to load. */
  constructor(private readonly api: Api, private readonly current: () => Preset, private readonly busy: (busy: boolean) => void) {}

  /** Resolves to null, and never rejects, if another preset was asked for meanwhile. */
  async load(name: string): Promise<Preset | null> {
    const request = ++this.requests;
    const isLatest = () => request === this.requests;
    const current = this.current();
    this.busy(name !== current.name);
    if (name === current.name) return current;
    try {
      const preset = await this.api.preset(name);
      return isLatest() ? preset : null;
    } catch (error) {
      if (isLatest()) throw error;
      return null;
    } finally {
      if (isLatest()) this.busy(false);
    }
  }
}
