/** Makes the chapter's figures live. */
import "./style.css";
import { Api } from "../api";
import { type MakeFigure, Runner } from "./parts/live";

const plots = () => import("./figures/plots");
const FIGURES: Record<string, MakeFigure> = {
  saturation: async (context) => (await plots()).saturation(context),
  threshold: async (context) => (await plots()).threshold(context),
  popping: async (context) => (await plots()).popping(context),
  masks: async (context) => (await plots()).masks(context),
  equations: async (context) => (await plots()).equations(context),
  picture: async (context) => (await import("./figures/picture")).picture(context),
};

const START = 0.9; // A time at which each figure has something to show, s

const api = new Api(new URL("../", document.baseURI).href);

for (const root of document.querySelectorAll<HTMLElement>("figure[data-figure]")) {
  const make = FIGURES[root.dataset["figure"] ?? ""];
  if (make === undefined) throw new Error(`There is no figure ${root.dataset["figure"] ?? ""}.`);
  new Runner(root, api, make, START).watch();
}
