/** The scene of the chapter's picture: that of the paper's figure 7, under any look. */
import type { Api } from "../../api";
import { type CameraState, cameraFromScene } from "../../camera/state";
import { type Json, withValue } from "../../scene/json";
import type { Look } from "../maths/looks";

const PRESET = "paper-halftone";
/** Fade of the filtered look, as a share of the plane. */
const FADE = 0.2;

interface PaperScene {
  /** The scene under a look. */
  under(look: Look): Json;
  /** The preset's camera at a height over the water, m. */
  from(height: number): CameraState;
}

export async function paperScene(api: Api): Promise<PaperScene> {
  const { scene } = await api.preset(PRESET);
  // Without the camera, which the page moves.
  const plain = withValue(scene, "/camera", undefined);
  const camera = cameraFromScene(scene);
  return {
    under: (look) => withValue(withValue(plain, "/foam/look", look), "/foam/fade", look === "filtered" ? FADE : 0),
    from: (height) => ({ ...camera, position: [camera.position[0], height, camera.position[2]] }),
  };
}
