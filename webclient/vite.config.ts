import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, constants } from "node:zlib";
import tailwindcss from "@tailwindcss/vite";
import { defineConfig, type Plugin } from "vitest/config";
import { sources } from "./build/sources.ts";

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

/**
 * Tweakpane writes its styles into a style element, which the page's security policy forbids; a constructed style sheet
 * is allowed.
 */
const paneStyles: Plugin = {
  name: "pane-styles",
  apply: "build",
  transform(code, id) {
    if (!/[\\/]tweakpane[\\/]dist[\\/]tweakpane(\.min)?\.js$/.test(id)) return null;
    const embed = "function embedStyle(doc, id, css) {";
    if (!code.includes(embed)) throw new Error("Tweakpane has no function embedStyle.");
    const adopt = `${embed}
      const sheet = new CSSStyleSheet();
      sheet.replaceSync(css);
      doc.adoptedStyleSheets.push(sheet);
    }`;
    return { code: code.replace(embed, `${adopt}\nfunction embedStyleElement(doc, id, css) {`), map: null };
  },
};

/** Writes the names of presets with a still into the page, of those whose sky is too pale for light type, and of those that are light and dark there. */
const stills: Plugin = {
  name: "stills",
  transformIndexHtml(html) {
    const names = readdirSync(join(import.meta.dirname, "public/stills")).flatMap((file) => /^([\w-]+)\.avif$/.exec(file)?.[1] ?? []);
    const index = JSON.parse(readFileSync(join(import.meta.dirname, "stills.json"), "utf8")) as Record<string, { ink: string; even: boolean }>;
    const those = (which: (one: { ink: string; even: boolean }) => boolean) => Object.entries(index).flatMap(([name, one]) => (which(one) ? [name] : []));
    const lists = { stills: names, pale: those(({ ink }) => ink === "dark"), uneven: those(({ even }) => !even) };
    return Object.entries(lists).reduce((page, [list, members]) => page.replace(`data-${list}=""`, `data-${list}="${members.join(" ")}"`), html);
  },
};

export default defineConfig({
  base: "./",
  build: {
    target: "es2022",
    assetsInlineLimit: 0,
    // Without it a browser that does not know the hints loads the same modules a little later.
    modulePreload: { polyfill: false },
    rolldownOptions: {
      // Few files for what every page with water needs at once: each of HTTP/1.1's six connections takes one at a time.
      output: {
        codeSplitting: {
          groups: [
            { name: "preact", test: /node_modules[\\/](@preact|preact)[\\/]/ },
            { name: "water", test: /webclient[\\/]src[\\/](api\.ts|(camera|gl|plan|scene)[\\/])/ },
            // By its own name, whatever else the accuracy benchmark and the mask laboratory share.
            { name: "linechart", test: /webclient[\\/]src[\\/]charts[\\/]linechart/ },
          ],
        },
      },
      input: ["index.html", "masks/index.html", "learn/index.html", "learn/laboratory/index.html"].map((page) => join(import.meta.dirname, page)),
    },
  },
  plugins: [tailwindcss(), manual, sources, brotli, paneStyles, stills],
  server: { proxy: { "/api": server, "/openapi.json": server, "/docs": server } },
  test: { include: ["tests/**/*.test.ts"] },
});
