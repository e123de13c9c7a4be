/** Touching the water: turns what the main pointer draws into rings of the scene, and says what the pointer does. */
import type { Clock } from "../app/clock";
import type { CameraControls, Stroke, StrokePoint } from "../camera/controls";
import type { FramePlan } from "../generated/api";
import { isObject, withValue } from "../scene/json";
import type { Store } from "../selection/store";
import { element } from "../ui/dom";
import { icon } from "../ui/icons";
import { pickWater, type WaterPlace } from "./pick";
import { appended, toJson, type Touch, touchAt, TOUCHES_POINTER, touchesOf, train } from "./touches";

/** While time stands, a ring is shown at this age, s: at its birth there is nothing to see. */
const AGE_AT_REST = 0.8;
/** A finger may be the first of two: it touches once it has rested this long, ms, or moved this far, px. */
const FINGER_DELAY = 90;
const FINGER_SLOP = 6;
const EFFECT = "touch";

/** A touch and the gesture that made it. */
interface MadeTouch {
  touch: Touch;
  gesture: number;
}

interface TouchEvents {
  /** The plan that is drawn; null before the first. */
  plan(): FramePlan | null;
  /** Whether a plan is loading. */
  busy(): boolean;
  /** The scene has touches, and no plan can show them. */
  refused(why: string): void;
}

export class TouchTool implements Stroke {
  readonly button = element("button", { type: "button", class: "round aria-pressed:border-current aria-pressed:text-accent", "data-tool": "touch" }, icon("touch"));
  private last: Touch | null = null;
  /** Where a finger has come down, until it is known to be alone. */
  private pending: { point: StrokePoint; timer: number } | null = null;
  /** Touches that a plan is being made for; only the first is in the scene already. */
  private waiting: MadeTouch[] | null = null;
  /** Number of the current gesture, a tap or a drag: one step of undo. */
  private gesture = 0;

  constructor(
    private readonly canvas: HTMLElement,
    private readonly store: Store,
    private readonly clock: Clock,
    private readonly controls: CameraControls,
    private readonly events: TouchEvents,
  ) {
    this.button.addEventListener("click", () => this.toggle());
    canvas.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
      if (event.code === "KeyT") this.toggle();
      if (event.code === "Enter") this.touchCentre();
    });
    this.toggle(true);
  }

  /** Whether the main pointer touches the water; else it moves the camera. */
  get on(): boolean {
    return this.controls.stroke === this;
  }

  toggle(on = !this.on): void {
    this.controls.stroke = on ? this : null;
    this.canvas.classList.toggle("touches", on);
    this.button.setAttribute("aria-pressed", String(on));
    this.button.setAttribute("aria-label", "Touch water");
    this.button.title = on ? "Drag touches the water: press to move the camera (T)" : "Drag moves the camera: press to touch the water (T)";
  }

  start(point: StrokePoint): boolean {
    this.end();
    if (this.events.plan() === null || this.pick(point) === null) return false;
    this.gesture += 1;
    if (point.pointerType !== "touch") this.touch(point);
    else this.pending = { point, timer: window.setTimeout(() => this.confirm(), FINGER_DELAY) };
    return true;
  }

  move(point: StrokePoint): void {
    const { pending } = this;
    if (pending && Math.hypot(point.clientX - pending.point.clientX, point.clientY - pending.point.clientY) > FINGER_SLOP) this.confirm();
    const to = this.last && this.pick(point);
    if (!this.last || !to) return;
    const time = this.now();
    const made = train(this.last, to).map((place) => touchAt(place, time));
    this.last = made.at(-1) ?? this.last;
    if (made.length > 0) this.add(made);
  }

  end(): void {
    this.confirm();
    this.last = null;
  }

  cancel(): void {
    clearTimeout(this.pending?.timer);
    this.pending = null;
    this.last = null;
  }

  /** A new plan is drawn: what waited for it is touched now. */
  planChanged(): void {
    const plan = this.events.plan();
    const { waiting } = this;
    if (waiting === null || plan === null) return;
    const touches = touchesOf(this.store.now.scene);
    const first = touches.at(-1);
    // The first was undone, or another preset was chosen meanwhile.
    if (!first || waiting[0] === undefined) this.waiting = null;
    else if (plan.live.includes(TOUCHES_POINTER)) {
      this.waiting = null;
      // The rings begin when they can be seen, as far apart in time as they were touched.
      const batch = [{ ...waiting[0], touch: first }, ...waiting.slice(1)];
      const late = this.clock.playing ? Math.max(0, this.now() - Math.max(...batch.map(({ touch }) => touch.time))) : 0;
      let list = touches.slice(0, -1);
      for (const { touch, gesture } of batch) {
        list = appended(list, [{ ...touch, time: Number((touch.time + late).toFixed(2)) }]);
        this.write(list, gesture);
      }
    } else this.refuse(plan, waiting[0].gesture);
  }

  /** A plan that leaves the touches out says why. */
  private refuse(plan: FramePlan, gesture: number): void {
    const skipped = plan.skipped.find(({ name }) => name === EFFECT);
    if (!skipped) return;
    this.waiting = null;
    this.write([], gesture);
    this.events.refused(skipped.why);
  }

  private touchCentre(): void {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    this.gesture += 1;
    if (this.events.plan() !== null) this.touch({ clientX: left + width / 2, clientY: top + height / 2, pointerType: "keyboard" });
    this.last = null;
  }

  private confirm(): void {
    const { pending } = this;
    if (pending === null) return;
    clearTimeout(pending.timer);
    this.pending = null;
    this.touch(pending.point);
  }

  private touch(point: StrokePoint): void {
    const place = this.pick(point);
    if (place === null) return;
    this.last = touchAt(place, this.now());
    this.add([this.last]);
  }

  private add(touches: readonly Touch[]): void {
    const made = touches.map((touch) => ({ touch, gesture: this.gesture }));
    if (this.waiting !== null && this.events.busy()) {
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

  private pick({ clientX, clientY }: StrokePoint): WaterPlace | null {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    return pickWater(this.controls.camera, clientX - left, clientY - top, width, height);
  }
}
