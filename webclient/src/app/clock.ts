/** Scene time, float64 seconds within ±10⁹. */

/** s: a frame at 4 a second, with time for one that comes late. */
const LONGEST_GAP = 0.4;

export class Clock {
  time = 0;
  speed = 1;
  private isPlaying = false;
  private readonly listeners = new Set<() => void>();

  get playing(): boolean {
    return this.isPlaying;
  }

  set playing(playing: boolean) {
    this.isPlaying = playing;
    this.notify();
  }

  /** Advances by `seconds` of real time; longer gaps, as in a hidden tab, are cut: the water keeps its pace at 4 frames a second. */
  advance(seconds: number): void {
    if (this.isPlaying) this.time += Math.min(seconds, LONGEST_GAP) * this.speed;
  }

  seek(time: number): void {
    if (!Number.isFinite(time)) return;
    this.time = Math.min(1e9, Math.max(-1e9, time));
    this.notify();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.notify();
  }

  /** Called on play, pause, seek and a change of speed; not on every frame. */
  onChange(listener: () => void): void {
    this.listeners.add(listener);
  }

  private notify(): void {
    for (const listener of this.listeners) listener();
  }
}
