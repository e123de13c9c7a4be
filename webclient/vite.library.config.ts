/**
 * Builds what leaves the page: the player of exported scenes (`--mode player`), the element's package (`--mode element`) and the
 * widget for notebooks (`--mode notebook`).
 */
import { copyFileSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { defineConfig, type Plugin } from "vitest/config";

const folder = import.meta.dirname;

/** Copies the licence beside the built file. */
const licence = (target: string): Plugin => ({
  name: "licence",
  writeBundle() {
    mkdirSync(join(folder, target), { recursive: true });
    copyFileSync(join(folder, "../LICENSE"), join(folder, target, "LICENSE"));
  },
});

const LIBRARIES = {
  // A classic script: pages opened from the file system may not load modules.
  player: { entry: "src/export/player.ts", format: "iife", fileName: "player.js", outDir: "dist/export", licenceIn: "dist/export" },
  notebook: { entry: "src/notebook/widget.ts", format: "es", fileName: "seafoam-widget.js", outDir: "dist/notebook", licenceIn: "dist/notebook" },
  element: { entry: "src/element/index.ts", format: "es", fileName: "seafoam-water.js", outDir: "element/dist", licenceIn: "element/dist" },
} as const;

export default defineConfig(({ mode }) => {
  const { entry, format, fileName, outDir, licenceIn } = LIBRARIES[mode as keyof typeof LIBRARIES];
  return {
    publicDir: false,
    build: {
      target: "es2022",
      outDir,
      emptyOutDir: false,
      lib: { entry: join(folder, entry), formats: [format], name: "seafoam", fileName: () => fileName },
    },
    plugins: [licence(licenceIn)],
  };
});
