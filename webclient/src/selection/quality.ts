/** Quality as text: a tier's name, or settings as JSON. */
import type { Json } from "../scene/json";

/** Quality for a request. */
export function parseQuality(text: string): Json {
  if (!text.startsWith("{")) return text;
  try {
    return JSON.parse(text) as Json;
  } catch {
    // The server reports the error.
    return text;
  }
}

export function qualityTitle(text: string): string {
  return text.startsWith("{") ? text.replace(/[{}"]/g, "").replace(/[:,]/g, "$& ").replaceAll("_", " ") : text;
}
