import js from "@eslint/js";
import tseslint from "typescript-eslint";

const SECURE_ONLY = [
  ...["clipboard", "credentials", "geolocation", "gpu", "locks", "mediaDevices", "serviceWorker", "share", "storage", "usb", "wakeLock", "xr"].map(
    (property) => ["navigator", property],
  ),
  ...["randomUUID", "subtle"].map((property) => ["crypto", property]),
  ...["caches", "cookieStore", "showOpenFilePicker", "showSaveFilePicker"].map((property) => ["window", property]),
];

export default tseslint.config(
  { ignores: ["dist", "element", "src/generated"] },
  js.configs.recommended,
  ...tseslint.configs.strictTypeChecked,
  {
    languageOptions: { parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname } },
    rules: {
      "@typescript-eslint/restrict-template-expressions": ["error", { allowNumber: true }],
      "@typescript-eslint/no-confusing-void-expression": ["error", { ignoreArrowShorthand: true, ignoreVoidReturningFunctions: true }],
      eqeqeq: "error",
      // Absent on a page over plain HTTP, but for localhost.
      "no-restricted-properties": ["error", ...SECURE_ONLY.map(([object, property]) => ({ object, property }))],
    },
  },
  { files: ["eslint.config.js", "make_types.js", "public/**/*.js"], ...tseslint.configs.disableTypeChecked },
  { files: ["make_types.js"], languageOptions: { globals: { URL: "readonly" } } },
  {
    files: ["public/**/*.js"],
    languageOptions: {
      sourceType: "script",
      globals: Object.fromEntries(
        ["document", "innerHeight", "innerWidth", "location", "SwaggerUIBundle", "URLSearchParams"].map((name) => [name, "readonly"]),
      ),
    },
  },
);
