/** Figure 6: the picture under each look, by the plan and the GLSL that the page draws with. */
import { effect, signal } from "@preact/signals";
import { render } from "preact";
import { element } from "../../ui/dom";
import { openContext, openGpu } from "../../gl/gpu";
import { Executor } from "../../plan/executor";
import { LOOK_TITLES, LOOKS, type Look } from "../maths/looks";
import { Choice, PlayButton, Slider } from "../parts/controls";
import type { FigureContext, LiveFigure } from "../parts/live";
import { paperScene } from "../parts/scene";

/** Of the picture; a renderer on the processor draws it smaller. */
const [ASPECT, WIDEST, WIDEST_SOFTWARE] = [16 / 9, 960, 640];
const [QUALITY, QUALITY_SOFTWARE] = ["standard", "draft"];

export async function make({ api, plate, controls, playing, redraw }: FigureContext): Promise<LiveFigure> {
  const canvas = element("canvas", { class: "picture aspect-video w-full", role: "img", "aria-label": "A wave with foam, in perspective" });
  const gpu = openGpu(openContext(canvas), new Set());
  const scene = await paperScene(api);
  const quality = gpu.capabilities.software ? QUALITY_SOFTWARE : QUALITY;
  const look = signal<Look>("halftone_textured");
  const height = signal(6.5);
  const busy = signal(false);
  const load = async (which: Look) => {
    const plan = await api.plan(scene.under(which), quality);
    return Executor.load(gpu, plan, (texture) => api.texture(texture), scene.from(height.peek()), false);
  };
  let drawn = look.value;
  let executor = await load(drawn);
  let lost = false;
  canvas.addEventListener("webglcontextlost", () => (lost = true));
  plate.append(canvas);
  effect(() => {
    const asked = look.value;
    if (asked === drawn) return;
    busy.value = true;
    void load(asked)
      .then((made) => {
        if (look.peek() !== asked) {
          made.dispose();
          return;
        }
        executor.dispose();
        executor = made;
        drawn = asked;
        plate.dataset["look"] = asked;
        redraw();
      })
      .finally(() => (busy.value = false));
  });
  height.subscribe(redraw);
  const Controls = () => (
    <>
      <PlayButton playing={playing} />
      <Choice label={busy.value ? "Look, compiling" : "Look"} value={look} options={LOOKS.map((one) => [one, LOOK_TITLES[one]] as const)} />
      <Slider label="Camera over the water" value={height} min={2} max={60} step={0.1} log unit=" m" />
    </>
  );
  render(<Controls />, controls);
  return {
    resize: (width) => {
      const most = gpu.capabilities.software ? WIDEST_SOFTWARE : WIDEST;
      canvas.width = Math.min(most, Math.round(width * devicePixelRatio));
      canvas.height = Math.round(canvas.width / ASPECT);
    },
    draw: (time) => {
      if (lost) return;
      const { width, height: tall } = canvas;
      executor.draw({ time, camera: scene.from(height.value), width, height: tall, screen: null, scissor: null, scene: null });
    },
  };
}
