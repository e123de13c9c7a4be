/** The shape of the source tree. */
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative, resolve } from "node:path";
import ts from "typescript";
import { describe, expect, it } from "vitest";

const SOURCES = join(import.meta.dirname, "../src");

const files = readdirSync(SOURCES, { recursive: true, withFileTypes: true }).flatMap((entry) => (entry.isFile() ? join(entry.parentPath, entry.name) : []));
const modules = new Set(files.filter((file) => /\.tsx?$/.test(file)));

/** Modules that a module imports: for types only and on demand, too. */
function importsOf(file: string): string[] {
  const { importedFiles } = ts.preProcessFile(readFileSync(file, "utf8"));
  return importedFiles.flatMap(({ fileName }) => {
    if (!fileName.startsWith(".")) return [];
    const base = resolve(dirname(file), fileName);
    return [base, `${base}.ts`, `${base}.tsx`].find((candidate) => modules.has(candidate)) ?? [];
  });
}

/** A circle of imports, from a module to itself; empty if there is none. */
function circle(graph: ReadonlyMap<string, readonly string[]>): readonly string[] {
  const done = new Set<string>();
  const visit = (module: string, path: readonly string[]): readonly string[] => {
    if (path.includes(module)) return [...path.slice(path.indexOf(module)), module];
    if (done.has(module)) return [];
    for (const next of graph.get(module) ?? []) {
      const found = visit(next, [...path, module]);
      if (found.length > 0) return found;
    }
    done.add(module);
    return [];
  };
  return [...graph.keys()].map((module) => visit(module, [])).find((found) => found.length > 0) ?? [];
}

describe("the source tree", () => {
  it("has no circle of imports", () => {
    const graph = new Map([...modules].map((file) => [file, importsOf(file)]));
    expect(graph.get(join(SOURCES, "main.ts"))).toContain(join(SOURCES, "app/app.ts"));
    expect(circle(graph).map((file) => relative(SOURCES, file))).toEqual([]);
  });

  it("exports what another module or a test uses", () => {
    const tests = readdirSync(import.meta.dirname, { recursive: true, encoding: "utf8" }).filter((name) => name.endsWith(".ts"));
    const texts = new Map([...modules, ...tests.map((name) => join(import.meta.dirname, name))].map((file) => [file, readFileSync(file, "utf8")]));
    const words = new Map([...texts].map(([file, text]) => [file, new Set(text.match(/[\w$]+/g))]));
    const unused = [...modules].filter((file) => !file.includes("generated")).flatMap((file) => {
      const exported = [...(texts.get(file) ?? "").matchAll(/^export (?:async )?(?:class|const|function|interface|type) (\w+)/gm)].map(([, name = ""]) => name);
      return exported.filter((name) => ![...words].some(([other, used]) => other !== file && used.has(name))).map((name) => `${relative(SOURCES, file)}: ${name}`);
    });
    expect(unused).toEqual([]);
  });
});
