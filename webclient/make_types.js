/**
 * Writes the types of what the client reads from the API: frame plans and their parts, from the OpenAPI document.
 * Usage: node make_types.js FILE
 */
import { readFileSync, writeFileSync } from "node:fs";
import { argv } from "node:process";
import openapiTS, { astToString, COMMENT_HEADER } from "openapi-typescript";

/** Schemas that the client has types for; those that they refer to are added. */
const ROOTS = ["FramePlan"];
const LONGEST_LINE = 120;

/** Without what a type says already: titles, that are the names, and discriminators. The server fills in all defaults. */
function plain(key, value) {
  if (key === "discriminator" || key === "default" || (key === "title" && typeof value === "string")) return undefined;
  if (value?.properties === undefined) return value;
  const given = Object.entries(value.properties).flatMap(([name, property]) => ("default" in property ? name : []));
  return { ...value, required: [...(value.required ?? []), ...given] };
}

const { openapi, info, components } = JSON.parse(readFileSync(new URL("openapi.json", import.meta.url), "utf8"));
const schemas = {};
const names = [...ROOTS];
for (let name = names.pop(); name !== undefined; name = names.pop()) {
  if (name in schemas) continue;
  const schema = components.schemas[name];
  if (schema === undefined) throw new Error(`The OpenAPI document has no schema ${name}.`);
  schemas[name] = schema;
  names.push(...[...JSON.stringify(schema).matchAll(/"#\/components\/schemas\/(\w+)"/g)].map(([, found]) => found));
}
const sorted = Object.fromEntries(Object.entries(schemas).sort(([a], [b]) => (a < b ? -1 : 1)));
const document = { openapi, info, paths: {}, components: { schemas: JSON.parse(JSON.stringify(sorted, plain)) } };
const types = await openapiTS(document);
const [, declared = ""] = /^ {4}schemas: \{\n(.*?)^ {4}\};\n/ms.exec(astToString(types)) ?? [];
const interfaces = declared
  .replace(/^ {8}/gm, "")
  .replace(/^(\w+): \{$/gm, "export interface $1 {")
  .replace(/^\};$/gm, "}")
  .replace(/components\["schemas"\]\["(\w+)"\]/g, "$1")
  // Without comments that name the kind of a value whose type stands below them; tuples and records in a line.
  .replace(/^ *\/\*\*\s+(\* )?@(enum \{\w+\}|constant)\s+(\* @enum \{\w+\}\s+)?\*\/\n/gm, "")
  .replace(/\/\*\*\s+\* @description (.*)\n\s+\* @enum \{string\}\n\s+\*\//g, "/** $1 */")
  .replaceAll("@description ", "")
  .replace(/\[\n\s+([\w,\s]+?)\n\s+\]/g, (_, members) => `[${members.replace(/\s+/g, " ")}]`)
  .replace(/\{\n\s+(\[key: string\]: [\w| ]+);\n\s+\}/g, "{ $1 }")
  .replace(/^ \* {5}/gm, " * ")
  // Few members without comments: on a line of their interface.
  .replace(/^(export interface \w+ \{)\n((?: {4}\w+\??: [^\n]+;\n)+)\}$/gm, (whole, head, members) => {
    const line = `${head} ${members.trim().replace(/;\n\s+/g, "; ")} }`;
    return line.length <= LONGEST_LINE ? line : whole;
  });
writeFileSync(argv[2], COMMENT_HEADER + interfaces);
