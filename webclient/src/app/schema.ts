/** Controls of the fields that the server's schema of scenes describes. */
import type { SceneSchema } from "../api";
import { controlOf, type GroupControl, schemaNamed } from "../panel/model";
import { CAMERA_POINTER } from "../plan/live";
import type { JsonObject } from "../scene/json";

/** Controls of the scene's fields, without the camera's, which is moved in the picture. */
export function sceneControls(document: SceneSchema, scene: JsonObject): GroupControl | null {
  const schema = schemaNamed(document, "Scene");
  const control = schema && controlOf(document, schema, scene, "", "scene");
  if (control?.kind !== "group") return null;
  return { ...control, children: control.children.filter(({ pointer }) => pointer !== CAMERA_POINTER) };
}
