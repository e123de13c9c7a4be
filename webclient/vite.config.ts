import { defineConfig } from "vitest/config";

/** Where a running Seafoam server answers during `npm run dev`. */
const server = process.env["SEAFOAM_SERVER"] ?? "http://127.0.0.1:8000";

export default defineConfig({
  base: "./",
  build: { target: "es2022", assetsInlineLimit: 0 },
  server: { proxy: { "/api": server, "/openapi.json": server, "/docs": server } },
  test: { include: ["tests/**/*.test.ts"] },
});
