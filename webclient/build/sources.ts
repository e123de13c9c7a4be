/**
 * Pages of source text that the chapter links to. A link names a file of the repository and a symbol in it, never a line, and a
 * link that leads nowhere fails the build.
 */
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Plugin } from "vite";

const REPOSITORY = join(import.meta.dirname, "../..");
const PAGES = join(import.meta.dirname, "../learn");
const LINK = /source\/([\w./-]+)\.html(?:#([\w-]+))?/g;

/** What a line defines, by the kind of file: a heading, a paragraph's term, a function, a part of a shader's file. */
const SYMBOLS: Record<string, RegExp> = {
  md: /^(?:#+ |\*\*|- \*)(?:[\d.]+b? )?([^*]+)/,
  glsl: /^(?:\/\/ @part |\w+ (?=\w+\())(\w+)/,
  py: /^(?:def|class) (\w+)/,
  ts: /^export (?:async )?(?:function|const|class|interface) (\w+)/,
};

/** Files that the pages link to, with the symbols that each must have. */
export function linkedSources(pages: readonly string[]): Map<string, Set<string>> {
  const found = new Map<string, Set<string>>();
  for (const page of pages) {
    for (const [, path = "", symbol] of page.matchAll(LINK)) {
      const symbols = found.get(path) ?? new Set();
      if (symbol !== undefined) symbols.add(symbol);
      found.set(path, symbols);
    }
  }
  return found;
}

const escaped = (text: string) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
const slug = (text: string) =>
  text
    .trim()
    .toLowerCase()
    .replace(/[^\w]+/g, "-")
    .replace(/^-+|-+$/g, "");

/** A page of a source text: a line each, whose first definition of a symbol has its name as id. Throws for a missing symbol. */
export function sourcePage(path: string, text: string, symbols: ReadonlySet<string>): string {
  const kind = path.split(".").at(-1) ?? "";
  const seen = new Set<string>();
  const lines = text.trimEnd().split("\n").map((line) => {
    const name = SYMBOLS[kind]?.exec(line)?.[1];
    const id = name === undefined ? "" : kind === "md" ? slug(name) : name;
    const own = id !== "" && !seen.has(id);
    seen.add(id);
    return `<li${own ? ` id="${id}"` : ""}><code>${escaped(line)}</code></li>`;
  });
  const missing = [...symbols].filter((symbol) => !seen.has(symbol));
  if (missing.length > 0) throw new Error(`${path} has no ${missing.join(", ")}, to which a page links.`);
  const up = "../".repeat(path.split("/").length);
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8" />
<meta name="viewport" content="width=device-width, initial-scale=1" />
<meta name="color-scheme" content="light dark" />
<title>${path} · Seafoam</title>
<link rel="icon" href="${up}icon.svg" type="image/svg+xml" />
<link rel="stylesheet" href="${up}source.css" />
</head>
<body class="${kind}">
<h1>${path}</h1>
<ol>
${lines.join("\n")}
</ol>
</body>
</html>
`;
}

function pagesOf(folder: string): string[] {
  return readdirSync(folder, { recursive: true, encoding: "utf8" })
    .filter((name) => name.endsWith(".html"))
    .map((name) => readFileSync(join(folder, name), "utf8"));
}

/** Every source page, by its address below `source/`. */
function allPages(): Map<string, string> {
  const pages = new Map<string, string>();
  for (const [path, symbols] of linkedSources(pagesOf(PAGES))) {
    pages.set(`${path}.html`, sourcePage(path, readFileSync(join(REPOSITORY, path), "utf8"), symbols));
  }
  return pages;
}

/** Adds the source pages to the build, and serves them in development. */
export const sources: Plugin = {
  name: "sources",
  generateBundle() {
    for (const [name, source] of allPages()) this.emitFile({ type: "asset", fileName: `source/${name}`, source });
  },
  configureServer({ middlewares }) {
    middlewares.use("/source/", (request, response, next) => {
      const page = allPages().get((request.url ?? "").slice(1).replace(/[?#].*/, ""));
      if (page === undefined) next();
      else response.setHeader("Content-Type", "text/html; charset=utf-8").end(page);
    });
  },
};
