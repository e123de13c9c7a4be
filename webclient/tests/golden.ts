import { readFileSync } from "node:fs";

/** Values that the server's implementation gives, too: tests/golden of the repository. */
export const golden = (name: string) => JSON.parse(readFileSync(new URL(`../../tests/golden/${name}.json`, import.meta.url), "utf8")) as unknown;
