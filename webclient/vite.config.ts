import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, constants } from "node:zlib";
import { defineConfig, type Plugin } from "vitest/config";

/** Seafoam server for `npm run dev`. */
const server = process.env["SEAFOAM_SERVER"] ?? "http://127.0.0.1:8000";

/** Writes Brotli files beside scripts and styles, for the server to send. */
const brotli: Plugin = {
  name: "brotli",
  apply: "build",
  writeBundle({ dir = "" }, bundle) {
    for (const [name, file] of Object.entries(bundle)) {
      const content = file.type === "chunk" ? file.code : file.source;
      // The best level takes 13 s for Swagger UI and saves a tenth of it.
      const params = { [constants.BROTLI_PARAM_QUALITY]: name.startsWith("docs/") ? 9 : constants.BROTLI_MAX_QUALITY };
      if (/\.(js|css)$/.test(name)) writeFileSync(join(dir, `${name}.br`), brotliCompressSync(content, { params }));
    }
  },
};

/** Adds the files of Swagger UI, with which the server shows its API reference. */
const manual: Plugin = {
  name: "manual",
  apply: "build",
  generateBundle() {
    for (const name of ["swagger-ui-bundle.js", "swagger-ui.css"])
      this.emitFile({
        type: "asset",
        fileName: `docs/${name}`,
        source: readFileSync(join(import.meta.dirname, "node_modules/swagger-ui-dist", name)),
      });
  },
};

/** Writes the names of presets with a still into the page. */
const stills: Plugin = {
  name: "stills",
  transformIndexHtml(html) {
    const names = readdirSync(join(import.meta.dirname, "public/stills")).flatMap((file) => /^([\w-]+)\.avif$/.exec(file)?.[1] ?? []);
    return html.replace("data-stills=\"\"", `data-stills="${names.join(" ")}"`);
  },
};

export default defineConfig({
  base: "./",
  build: { target: "es2022", assetsInlineLimit: 0 },
  plugins: [manual, brotli, stills],
  server: { proxy: { "/api": server, "/openapi.json": server, "/docs": server } },
  test: { include: ["tests/**/*.test.ts"] },
});
