/** What the page reads from the server's OpenAPI document: the scene's fields and the quality tiers. */
import { controlOf, type GroupControl, schemaNamed } from "../panel/model";
import { CAMERA_POINTER } from "../plan/live";
import { get, isObject, type JsonObject } from "../scene/json";

export const DEFAULT_TIER = "standard";

/** Controls of the scene's fields, without the camera's, which is moved in the picture. */
export function sceneControls(openapi: JsonObject, scene: JsonObject): GroupControl | null {
  const schema = schemaNamed(openapi, "Scene");
  const control = schema && controlOf(openapi, schema, scene, "", "scene");
  if (control?.kind !== "group") return null;
  return { ...control, children: control.children.filter(({ pointer }) => pointer !== CAMERA_POINTER) };
}

/** The enum of the plan endpoint's quality parameter. */
export function tierNames(openapi: JsonObject): string[] {
  const parameters = get(openapi, "/paths/~1api~1plans~1{preset}/get/parameters");
  const parameter = Array.isArray(parameters) ? parameters.find((candidate) => isObject(candidate) && candidate["name"] === "quality") : undefined;
  const schema = parameter === undefined ? undefined : get(parameter, "/schema");
  const reference = isObject(schema) ? schema["$ref"] : undefined;
  const resolved = typeof reference === "string" ? get(openapi, reference.slice(1)) : schema;
  const tiers = isObject(resolved) ? resolved["enum"] : undefined;
  return Array.isArray(tiers) ? tiers.filter((tier) => typeof tier === "string") : [DEFAULT_TIER];
}
