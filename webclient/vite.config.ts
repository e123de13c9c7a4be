import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync } from "node:zlib";
import { defineConfig, type Plugin } from "vitest/config";

/** Where a running Seafoam server answers during `npm run dev`. */
const server = process.env["SEAFOAM_SERVER"] ?? "http://127.0.0.1:8000";

/** Scripts and styles beside themselves as Brotli has them, which the server sends to who takes it. */
const brotli: Plugin = {
  name: "brotli",
  apply: "build",
  writeBundle({ dir = "" }, bundle) {
    for (const [name, file] of Object.entries(bundle)) {
      const content = file.type === "chunk" ? file.code : file.source;
      if (/\.(js|css)$/.test(name)) writeFileSync(join(dir, `${name}.br`), brotliCompressSync(content));
    }
  },
};

export default defineConfig({
  base: "./",
  build: { target: "es2022", assetsInlineLimit: 0 },
  plugins: [brotli],
  server: { proxy: { "/api": server, "/openapi.json": server, "/docs": server } },
  test: { include: ["tests/**/*.test.ts"] },
});
