/**
 * Makes the folder that holds the page and its files the base of all relative addresses. Called once, when the page opens:
 * the path changes with the preset, and relative addresses would follow it.
 */
export function pinRoot(): void {
  const base = document.querySelector("base") ?? document.head.appendChild(document.createElement("base"));
  base.href = new URL(".", document.baseURI).href;
}
