/** A quality as the page holds it: a tier's name, or single knobs as JSON. */
import type { Json } from "../scene/json";

/** What the server is asked with. */
export function qualityOf(text: string): Json {
  if (!text.startsWith("{")) return text;
  try {
    return JSON.parse(text) as Json;
  } catch {
    // The server says what is wrong with it.
    return text;
  }
}

/** How it is listed among the tiers. */
export function qualityTitle(text: string): string {
  return text.startsWith("{") ? text.replace(/[{}"]/g, "").replace(/[:,]/g, "$& ").replaceAll("_", " ") : text;
}
