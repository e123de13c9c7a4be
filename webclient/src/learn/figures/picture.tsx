/** Figure 6: the picture under each look, by the plan and the GLSL that the page draws with. */
import { effect, signal } from "@preact/signals";
import { cameraFromScene } from "../../camera/state";
import { openContext, openGpu } from "../../gl/gpu";
import { Executor } from "../../plan/executor";
import { withValue } from "../../scene/json";
import { element } from "../../ui/dom";
import { type Look, LOOKS } from "../maths/wave";
import { Choice, type FigureContext, type LiveFigure, Slider } from "../parts/live";

/** Of the picture; a renderer on the processor draws it smaller. */
const [ASPECT, WIDEST, WIDEST_SOFTWARE] = [16 / 9, 960, 640];
const [QUALITY, QUALITY_SOFTWARE] = ["standard", "fast"];
const PRESET = "paper-halftone"; // The scene: the paper's figure 7
const FADE = 0.2; // Fade of the filtered look, as a share of the plane

export async function picture({ api, plate, redraw }: FigureContext): Promise<LiveFigure> {
  const canvas = element("canvas", { class: "picture aspect-video w-full", role: "img", "aria-label": "A wave with foam, in perspective" });
  const gpu = openGpu(openContext(canvas), new Set());
  const { scene } = await api.preset(PRESET);
  // Without the camera, which the page moves.
  const plain = withValue(scene, "/camera", undefined);
  const under = (which: Look) => withValue(withValue(plain, "/foam/look", which), "/foam/fade", which === "filtered" ? FADE : 0);
  const camera = cameraFromScene(scene);
  const cameraAt = (metres: number) => ({ ...camera, position: [camera.position[0], metres, camera.position[2]] as const });
  const quality = gpu.capabilities.software ? QUALITY_SOFTWARE : QUALITY;
  const look = signal<Look>("halftone_textured");
  const height = signal(6.5);
  const busy = signal(false);
  const load = async (which: Look) => {
    const plan = await api.plan(under(which), quality);
    return Executor.load(gpu, plan, api.texture, cameraAt(height.peek()), false);
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
  const Controls = () => (
    <>
      <Choice label={busy.value ? "Look, compiling" : "Look"} value={look} options={(Object.keys(LOOKS) as Look[]).map((one) => [one, LOOKS[one].title] as const)} />
      <Slider label="Camera over the water" value={height} min={2} max={60} step={0.1} log unit=" m" />
    </>
  );
  return {
    controls: <Controls />,
    inputs: [height],
    resize: (width) => {
      const most = gpu.capabilities.software ? WIDEST_SOFTWARE : WIDEST;
      canvas.width = Math.min(most, Math.round(width * devicePixelRatio));
      canvas.height = Math.round(canvas.width / ASPECT);
    },
    draw: (time) => {
      if (lost) return;
      const { width, height: tall } = canvas;
      executor.draw({ time, camera: cameraAt(height.value), width, height: tall, screen: null, scissor: null, scene: null });
    },
  };
}
