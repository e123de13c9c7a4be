/**
 * Writes the types of what the client reads from the API: frame plans and their parts, from the OpenAPI document.
 * Usage: node make_types.js FILE
 */
import { readFileSync, writeFileSync } from "node:fs";
import { argv } from "node:process";
import openapiTS, { astToString, COMMENT_HEADER } from "openapi-typescript";

/** Schemas that the client has types for; those that they refer to are added. */
const ROOTS = ["FramePlan"];

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
const types = await openapiTS(document, { rootTypes: true, rootTypesNoSchemaPrefix: true });
// Comments that name the kind of a value whose type stands below them.
const bare = astToString(types).replace(/^ *\/\*\*\s+(\* )?@(enum \{\w+\}|constant)\s+(\* @enum \{\w+\}\s+)?\*\/\n/gm, "");
writeFileSync(argv[2], COMMENT_HEADER + bare);
