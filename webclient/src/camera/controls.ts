/** Camera controls by mouse, touch, pen and keyboard. */
import { type CameraState, look, move, orbit, pivot, type Pivot, scaleFov, zoom } from "./state";

export type CameraMode = "orbit" | "fly";

const KEY_TURN_SPEED = 0.9; // rad/s
const SPRINT_FACTOR = 4;
const INERTIA = 0.11; // Time constant of inertia, s
const MIN_SPEED = 1e-4;

/** A touch that begins this near to the left or right edge is the browser's: a swipe back or forward, CSS px. */
const EDGE = 24;

type Point = { x: number; y: number };

export type PointerPosition = Pick<PointerEvent, "clientX" | "clientY" | "pointerType">;

/** What the main pointer, a single finger or the left button, does if it does not move the camera. */
export interface PointerTool {
  start(point: PointerPosition): boolean; // Returns whether it takes the pointer; else that moves the camera
  move(point: PointerPosition): void;
  end(): void;
  cancel(): void; // A second finger has come down: both move the camera
}

export const CLEARANCE = 0.3; // Least distance of the camera from the water's bounds, m

export class CameraControls {
  camera: CameraState;
  mode: CameraMode = "orbit";
  /** Least heights, m: of an orbit, and of flying or diving. */
  surface = 0.5;
  bottom = 0.5;
  tool: PointerTool | null = null; // Takes the main pointer; null: it moves the camera
  private toolPointer: number | null = null; // The pointer that the tool has taken
  private readonly keys = new Set<string>();
  private readonly pointers = new Map<number, Point>();
  private turning = { yaw: 0, pitch: 0 }; // Pending rotation, rad
  private speed = { right: 0, up: 0, forward: 0 }; // Relative to the camera's height, per second
  private orbitPivot: Pivot | null = null; // Centre of the current orbit; reset by every other move
  private readonly listeners = new Set<() => void>();

  constructor(private readonly element: HTMLElement, camera: CameraState, private readonly smooth: boolean) {
    this.camera = camera;
    element.addEventListener("pointerdown", this.pointerDown);
    element.addEventListener("pointermove", this.pointerMove);
    for (const type of ["pointerup", "pointercancel"] as const) element.addEventListener(type, this.pointerUp);
    element.addEventListener("wheel", this.wheel, { passive: false });
    element.addEventListener("keydown", this.keyDown);
    element.addEventListener("keyup", (event) => this.keys.delete(event.code));
    element.addEventListener("blur", () => this.keys.clear());
    element.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  onMove(listener: () => void): void {
    this.listeners.add(listener);
  }

  set(camera: CameraState): void {
    this.moveTo(camera);
    this.turning = { yaw: 0, pitch: 0 };
    this.speed = { right: 0, up: 0, forward: 0 };
    this.notify();
  }

  /** Advances by `seconds`; returns whether the camera moved. */
  step(seconds: number): boolean {
    const before = this.camera;
    const dt = Math.min(seconds, 0.1);
    const isHeld = (...codes: string[]) => (codes.some((code) => this.keys.has(code)) ? 1 : 0);
    const sprint = isHeld("ShiftLeft", "ShiftRight") ? SPRINT_FACTOR : 1;
    const targetSpeed = {
      right: (isHeld("KeyD") - isHeld("KeyA")) * sprint,
      up: (isHeld("KeyE", "PageUp") - isHeld("KeyQ", "PageDown")) * sprint,
      forward: (isHeld("KeyW") - isHeld("KeyS")) * sprint,
    };
    const blend = this.smooth ? 1 - Math.exp(-dt / INERTIA) : 1;
    for (const axis of ["right", "up", "forward"] as const) {
      this.speed[axis] += (targetSpeed[axis] - this.speed[axis]) * blend;
      if (Math.abs(this.speed[axis]) < MIN_SPEED) this.speed[axis] = 0;
    }
    const { right, up, forward } = this.speed;
    if (right || up || forward) {
      // Speed is proportional to height.
      const metres = Math.max(1.5, Math.abs(this.camera.position[1]) * 0.8) * dt;
      this.moveTo(move(this.camera, right * metres, up * metres, forward * metres, this.minHeight(up < 0)));
    }
    const turnStep = KEY_TURN_SPEED * dt;
    this.turning.yaw += (isHeld("ArrowRight") - isHeld("ArrowLeft")) * turnStep;
    this.turning.pitch += (isHeld("ArrowUp") - isHeld("ArrowDown")) * turnStep;
    if (Math.abs(this.turning.yaw) + Math.abs(this.turning.pitch) > MIN_SPEED) {
      const share = this.smooth ? 1 - Math.exp(-dt / (INERTIA / 2)) : 1;
      this.turn(this.turning.yaw * share, this.turning.pitch * share);
      this.turning.yaw *= 1 - share;
      this.turning.pitch *= 1 - share;
    }
    if (isHeld("Equal", "NumpadAdd")) this.moveTo(zoom(this.camera, Math.exp(-dt), this.minHeight()));
    if (isHeld("Minus", "NumpadSubtract")) this.moveTo(zoom(this.camera, Math.exp(dt), this.minHeight()));
    const moved = this.camera !== before;
    if (moved) this.notify();
    return moved;
  }

  /** Underwater only by flying or diving; a camera below its limit may stay there. */
  private minHeight(diving = false): number {
    const [, y] = this.camera.position;
    return Math.min(diving || this.mode === "fly" || y < this.surface ? this.bottom : this.surface, y);
  }

  private notify(): void {
    for (const listener of this.listeners) listener();
  }

  private turn(yaw: number, pitch: number): void {
    this.camera =
      this.mode === "fly"
        ? look(this.camera, yaw, pitch)
        : orbit(this.camera, (this.orbitPivot ??= pivot(this.camera)), yaw, pitch, this.minHeight());
  }

  /** Any move but a rotation. */
  private moveTo(camera: CameraState): void {
    this.camera = camera;
    this.orbitPivot = null;
  }

  private readonly pointerDown = (event: PointerEvent): void => {
    if (event.pointerType === "touch" && Math.min(event.clientX, this.element.clientWidth - event.clientX) < EDGE) return;
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.toolPointer !== null) {
      this.tool?.cancel();
      this.toolPointer = null;
    } else if (this.pointers.size === 1 && event.button === 0 && !event.shiftKey && this.tool?.start(event)) {
      this.toolPointer = event.pointerId;
    }
  };

  private readonly pointerUp = (event: PointerEvent): void => {
    this.pointers.delete(event.pointerId);
    if (event.pointerId !== this.toolPointer) return;
    this.toolPointer = null;
    if (event.type === "pointerup") this.tool?.end();
    else this.tool?.cancel();
  };

  private readonly pointerMove = (event: PointerEvent): void => {
    if (event.pointerId === this.toolPointer) {
      this.tool?.move(event);
      return;
    }
    const last = this.pointers.get(event.pointerId);
    if (last === undefined) return;
    const now = { x: event.clientX, y: event.clientY };
    const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
    this.pointers.set(event.pointerId, now);
    const [dx, dy] = [now.x - last.x, now.y - last.y];
    // A drag across the window's height rotates by the field of view.
    const radians = this.camera.fov / this.element.clientHeight;
    const metres = pivot(this.camera).distance * radians;
    if (other) {
      const span = (t: Point) => Math.hypot(t.x - other.x, t.y - other.y);
      this.moveTo(zoom(this.camera, span(last) / Math.max(span(now), 1), this.minHeight()));
      // Where one finger touches the water, two must turn the view too.
      if (this.tool) this.rotate(dx / 2, dy / 2, radians);
      else this.moveTo(move(this.camera, (-dx / 2) * metres, (dy / 2) * metres, 0, this.minHeight()));
      this.notify();
    } else if (this.pans(event)) {
      this.moveTo(move(this.camera, -dx * metres, dy * metres, 0, this.minHeight()));
      this.notify();
    } else {
      this.rotate(dx, dy, radians);
    }
  };

  /** Whether a drag moves the eye sideways: with shift, or by the button that does not rotate. */
  private pans({ buttons, shiftKey }: PointerEvent): boolean {
    return (buttons & 4) !== 0 || ((buttons & 3) !== 0 && shiftKey) || ((buttons & 2) !== 0 && this.tool === null);
  }

  private rotate(dx: number, dy: number, radians: number): void {
    const sign = this.mode === "fly" ? -1 : -1.6;
    this.turning.yaw += sign * dx * radians;
    this.turning.pitch -= sign * dy * radians;
  }

  private readonly wheel = (event: WheelEvent): void => {
    event.preventDefault();
    // Units are pixels, lines or pages; a trackpad pinch is a wheel event with Ctrl.
    const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1);
    const factor = Math.exp(Math.max(-240, Math.min(240, pixels)) * (event.ctrlKey ? 0.01 : 0.0012));
    this.moveTo(event.shiftKey ? scaleFov(this.camera, factor) : zoom(this.camera, factor, this.minHeight()));
    this.notify();
  };

  private readonly keyDown = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    this.keys.add(event.code);
    if (event.code.startsWith("Arrow") || event.code.startsWith("Page")) event.preventDefault();
  };
}
