/**
 * Builds what leaves the page: the player of exported scenes (`--mode player`), the element's package (`--mode element`) and the
 * widget for notebooks (`--mode notebook`).
 */
import { cpSync } from "node:fs";
import { join } from "node:path";
import { defineConfig, type Plugin } from "vitest/config";

const folder = import.meta.dirname;

/** Copies the licence beside the built file, and the shader snippets where they belong to it. */
const beside = (target: string, snippets: string | null): Plugin => ({
  name: "beside",
  writeBundle() {
    cpSync(join(folder, "../LICENSE"), join(folder, target, "LICENSE"));
    if (snippets !== null) cpSync(join(folder, "../docs/snippets"), join(folder, snippets), { recursive: true });
  },
});

const LIBRARIES = {
  // A classic script: pages opened from the file system may not load modules.
  player: { entry: "src/export/player.ts", format: "iife", fileName: "player.js", outDir: "dist/export", snippets: "dist/export/snippets" },
  notebook: { entry: "src/notebook/widget.ts", format: "es", fileName: "seafoam-widget.js", outDir: "dist/notebook", snippets: null },
  element: { entry: "src/element/index.ts", format: "es", fileName: "seafoam-water.js", outDir: "element/dist", snippets: "element/snippets" },
} as const;

export default defineConfig(({ mode }) => {
  const { entry, format, fileName, outDir, snippets } = LIBRARIES[mode as keyof typeof LIBRARIES];
  return {
    publicDir: false,
    build: {
      target: "es2022",
      outDir,
      emptyOutDir: false,
      lib: { entry: join(folder, entry), formats: [format], name: "seafoam", fileName: () => fileName },
    },
    plugins: [beside(outDir, snippets)],
  };
});
