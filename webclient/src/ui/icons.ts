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
