/** Addresses of presets: `water/NAME` below the page's root. */

const FOLDER = "water/";
const PATH = /\/water\/([\w-]+)$/;

/** Address of a preset. The server gives it title, description and picture. */
export const waterUrl = (name: string) => new URL(FOLDER + encodeURIComponent(name), document.baseURI).href;

/** The preset that a path names, or null. */
export const presetOfPath = (pathname: string) => PATH.exec(pathname)?.[1] ?? null;

/** Whether a click on a link is for the browser, such as for a new tab; otherwise its default is prevented. */
export function followsLink(event: MouseEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return true;
  event.preventDefault();
  return false;
}
