/** The time of the sea. Float64 seconds, so that any moment within ±10⁹ s can be shown exactly. */

export class Clock {
  time = 0;
  speed = 1;
  private running = false;
  private readonly listeners = new Set<() => void>();

  get playing(): boolean {
    return this.running;
  }

  set playing(playing: boolean) {
    this.running = playing;
    this.tell();
  }

  /** Moves on by `seconds` of the wall clock; long gaps, such as a hidden tab, are skipped. */
  advance(seconds: number): void {
    if (this.running) this.time += Math.min(seconds, 0.25) * this.speed;
  }

  jump(time: number): void {
    if (!Number.isFinite(time)) return;
    this.time = Math.min(1e9, Math.max(-1e9, time));
    this.tell();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.tell();
  }

  /** Called on play, pause, jump and speed; not on every frame. */
  onChange(listener: () => void): void {
    this.listeners.add(listener);
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
