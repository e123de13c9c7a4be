/** Touching the water: turns what the main pointer draws into rings of the scene, and says what the pointer does. */
import type { Clock } from "../app/transport";
import type { CameraControls, PointerTool, PointerPosition } from "../camera/controls";
import type { FramePlan } from "../generated/api";
import { isObject, withValue } from "../scene/json";
import type { Store } from "../selection/selection";
import { button, hasModifier } from "../ui/dom";
import { icon } from "../ui/icons";
import { appended, pickWater, toJson, type Touch, touchAt, TOUCHES_POINTER, touchesOf, train, type WaterPlace } from "./touches";

const AGE_AT_REST = 0.8; // While time stands, a ring is shown at this age, s: at its birth there is nothing to see
/** A finger may be the first of two: it touches once it has rested this long, ms, or moved this far, px. */
const FINGER_DELAY = 90;
const FINGER_SLOP = 6;
const EFFECT = "touch";

/** What the main pointer does. */
type PointerState =
  | { is: "up" }
  /** A finger has come down; it is not known yet whether it is alone. */
  | { is: "resting"; point: PointerPosition; timer: number }
  /** It has touched the water, and a drag leaves rings behind it; `last`: the newest. */
  | { is: "touching"; last: Touch };

const UP: PointerState = { is: "up" };

/** A touch and the gesture that made it. */
type MadeTouch = { touch: Touch; gesture: number };

interface TouchEvents {
  plan(): FramePlan | null; // The plan that is drawn; null before the first
  busy(): boolean;
  refused(why: string): void; // The scene has touches, and no plan can show them
}

export class TouchTool implements PointerTool {
  readonly button = button({ class: "round aria-pressed:border-current aria-pressed:text-accent", "data-tool": "touch" }, () => this.toggle(), icon("touch"));
  private pointer: PointerState = UP;
  /** Touches that wait for a plan with room for touches; only the first is in the scene already. */
  private waiting: MadeTouch[] = [];
  private gesture = 0; // Number of the current gesture, a tap or a drag: one step of undo

  constructor(
    private readonly canvas: HTMLElement,
    private readonly store: Store,
    private readonly clock: Clock,
    private readonly controls: CameraControls,
    private readonly events: TouchEvents,
  ) {
    canvas.addEventListener("keydown", (event) => {
      if (hasModifier(event) || event.repeat) return;
      if (event.code === "KeyT") this.toggle();
      if (event.code === "Enter") this.touchCentre();
    });
    this.toggle(true);
  }

  /** Whether the main pointer touches the water; else it moves the camera. */
  get on(): boolean { return this.controls.tool === this; }

  toggle(on = !this.on): void {
    this.controls.tool = on ? this : null;
    this.canvas.classList.toggle("touches", on);
    this.button.setAttribute("aria-pressed", String(on));
    this.button.setAttribute("aria-label", "Touch water");
    this.button.title = on ? "Drag touches the water: press to move the camera (T)" : "Drag moves the camera: press to touch the water (T)";
  }

  start(point: PointerPosition): boolean {
    this.end();
    if (this.events.plan() === null || this.pick(point) === null) return false;
    this.gesture += 1;
    if (point.pointerType !== "touch") this.touch(point);
    else this.pointer = { is: "resting", point, timer: window.setTimeout(() => this.confirm(), FINGER_DELAY) };
    return true;
  }

  move(point: PointerPosition): void {
    const { pointer } = this;
    if (pointer.is === "resting" && Math.hypot(point.clientX - pointer.point.clientX, point.clientY - pointer.point.clientY) > FINGER_SLOP) this.confirm();
    const last = this.pointer.is === "touching" ? this.pointer.last : null;
    const to = last && this.pick(point);
    if (!to) return;
    const time = this.now();
    const made = train(last, to).map((place) => touchAt(place, time));
    if (made.length === 0) return;
    this.pointer = { is: "touching", last: made.at(-1) ?? last };
    this.add(made);
  }

  end(): void {
    this.confirm();
    this.pointer = UP;
  }

  cancel(): void {
    if (this.pointer.is === "resting") clearTimeout(this.pointer.timer);
    this.pointer = UP;
  }

  /** A new plan is drawn: what waited for it is touched now. */
  planChanged(): void {
    const plan = this.events.plan();
    const [first, ...others] = this.waiting;
    if (first === undefined || plan === null) return;
    const touches = touchesOf(this.store.now.scene);
    const present = touches.at(-1);
    // The first was undone, or another preset was chosen meanwhile.
    if (!present) this.waiting = [];
    else if (plan.live.includes(TOUCHES_POINTER)) {
      this.waiting = [];
      // The rings begin when they can be seen, as far apart in time as they were touched.
      const batch = [{ ...first, touch: present }, ...others];
      const late = this.clock.playing ? Math.max(0, this.now() - Math.max(...batch.map(({ touch }) => touch.time))) : 0;
      let list = touches.slice(0, -1);
      for (const { touch, gesture } of batch) {
        list = appended(list, [{ ...touch, time: Number((touch.time + late).toFixed(2)) }]);
        this.write(list, gesture);
      }
    } else this.refuse(plan, first.gesture);
  }

  /** A plan that leaves the touches out says why. */
  private refuse(plan: FramePlan, gesture: number): void {
    const skipped = plan.skipped.find(({ name }) => name === EFFECT);
    if (!skipped) return;
    this.waiting = [];
    this.write([], gesture);
    this.events.refused(skipped.why);
  }

  private touchCentre(): void {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    this.end();
    this.gesture += 1;
    if (this.events.plan() !== null) this.touch({ clientX: left + width / 2, clientY: top + height / 2, pointerType: "keyboard" });
    this.pointer = UP;
  }

  /** A finger that rests is alone: it touches. */
  private confirm(): void {
    const { pointer } = this;
    if (pointer.is !== "resting") return;
    this.cancel();
    this.touch(pointer.point);
  }

  private touch(point: PointerPosition): void {
    const place = this.pick(point);
    if (place === null) return;
    const touch = touchAt(place, this.now());
    this.pointer = { is: "touching", last: touch };
    this.add([touch]);
  }

  private add(touches: readonly Touch[]): void {
    const made = touches.map((touch) => ({ touch, gesture: this.gesture }));
    if (this.waiting.length > 0 && this.events.busy()) {
      this.waiting.push(...made);
      return;
    }
    // The first touch of a preset asks for a plan with room for touches; more would each ask for it anew.
    const room = this.events.plan()?.live.includes(TOUCHES_POINTER) === true;
    if (!room) this.waiting = made;
    this.write(appended(touchesOf(this.store.now.scene), room ? touches : touches.slice(0, 1)), this.gesture);
  }

  private write(touches: readonly Touch[], gesture: number): void {
    const scene = withValue(this.store.now.scene, TOUCHES_POINTER, toJson(touches));
    if (isObject(scene)) this.store.set({ scene }, `touch ${gesture}`);
  }

  private now(): number {
    return this.clock.time - (this.clock.playing ? 0 : AGE_AT_REST);
  }

  private pick({ clientX, clientY }: PointerPosition): WaterPlace | null {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    return pickWater(this.controls.camera, clientX - left, clientY - top, width, height);
  }
}
