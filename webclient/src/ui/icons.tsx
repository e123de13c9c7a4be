/** Line icons, drawn on a 24 × 24 grid. */

const PATHS = {
  play: "M8 5.500v13l10.500-6.500z",
  pause: "M8.500 5.500v13M15.500 5.500v13",
  reset: "M5 12a7 7 0 1 0 2.300-5.200M5 4.500V9h4.500",
  compare: "M12 4v16M5 7.500h4M5 12h4M5 16.500h4M15 7.500h4M15 12h4M15 16.500h4",
  download: "M12 4.500v10.500M7.500 11l4.500 4.500 4.500-4.500M5 19.500h14",
  link: "M10 14a4 4 0 0 0 6 .4l2.600-2.600a4 4 0 0 0-5.700-5.700L11.600 7.400M14 10a4 4 0 0 0-6-.4l-2.600 2.600a4 4 0 0 0 5.700 5.700l1.300-1.300",
  settings: "M4 7.500h9M17 7.500h3M4 16.500h3M11 16.500h9M15 5.500v4M9 14.500v4",
  accuracy: "M4.500 4.500v15h15M8 9.500c1 4.500 4 6 10.500 6.300M8 9.500h.01M11.300 13.900h.01M18.500 15.800h.01",
  fullscreen: "M4.500 9V4.500H9M15 4.500h4.500V9M19.500 15v4.500H15M9 19.500H4.500V15",
  masks: "M4.500 4.500h15v15h-15zM8 8h.01M12 9h.01M16.200 7.800h.01M9.200 12.400h.01M14 13h.01M8 16h.01M12 16.500h.01M16.500 16h.01",
  take: "M4.500 8.500 12 4.500l7.500 4v7.500L12 20l-7.500-4zM4.500 8.500 12 12.500l7.500-4M12 12.500V20",
  plan: "M4.500 4.500h5v4h-5zM14.500 10h5v4h-5zM4.500 15.500h5v4h-5zM9.500 6.500h2.500v11H9.500M12 12h2.500",
  foam: "M9 11.500a3.500 3.500 0 1 0 .01 0M16.500 5a2.500 2.500 0 1 0 .01 0M16.500 14.500a2 2 0 1 0 .01 0M5.500 5.500a1.500 1.500 0 1 0 .01 0",
  touch: "M12 11.500v-7M9.500 7l2.500-2.500 2.500 2.500M8 14.200c-2 .4-3.500 1.100-3.500 2 0 1.500 3.400 2.800 7.500 2.800s7.500-1.300 7.500-2.800c0-.9-1.500-1.600-3.500-2M9.500 15.500c.7-.3 1.600-.5 2.500-.5s1.800.2 2.500.5",
  search: "M10.500 4.500a6 6 0 1 0 0 12a6 6 0 1 0 0-12M15 15l5 5",
  close: "M6.500 6.500l11 11M17.500 6.500l-11 11",
} as const;

export type IconName = keyof typeof PATHS;

const SVG = "http://www.w3.org/2000/svg";

export function icon(name: IconName): SVGSVGElement {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(SVG, "path");
  path.setAttribute("d", PATHS[name]);
  svg.append(path);
  return svg;
}

/** The same in Preact's markup. */
export function Icon({ name }: { name: IconName }) {
  return <svg viewBox="0 0 24 24" aria-hidden="true"><path d={PATHS[name]} /></svg>;
}
