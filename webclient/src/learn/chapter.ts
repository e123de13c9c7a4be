/** Makes the chapter's figures live. */
import "./style.css";
import { Api } from "../api";
import { type MakeFigure, Runner } from "./parts/live";

const FIGURES: Record<string, () => Promise<{ make: MakeFigure }>> = {
  saturation: () => import("./figures/saturation"),
  threshold: () => import("./figures/threshold"),
  popping: () => import("./figures/popping"),
  masks: () => import("./figures/masks"),
  equations: () => import("./figures/equations"),
  picture: () => import("./figures/picture"),
};

/** A time at which each figure has something to show, s. */
const START = 0.9;

const api = new Api(new URL("../", document.baseURI).href);

for (const root of document.querySelectorAll<HTMLElement>("figure[data-figure]")) {
  const load = FIGURES[root.dataset["figure"] ?? ""];
  if (load === undefined) throw new Error(`There is no figure ${root.dataset["figure"] ?? ""}.`);
  new Runner(root, api, () => load().then(({ make }) => make), START).watch();
}
