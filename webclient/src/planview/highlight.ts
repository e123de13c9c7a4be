/** Splits GLSL into tokens for display; their texts, joined, are the source. */

const KINDS = ["comment", "directive", "keyword", "type", "number"] as const;

export type TokenKind = (typeof KINDS)[number] | "plain";

type Token = { kind: TokenKind; text: string };

const KEYWORDS =
  "break|case|centroid|const|continue|default|discard|do|else|false|flat|for|highp|if|in|inout|invariant|layout|lowp|mediump|out|precision|return|smooth|struct|switch|true|uniform|while";
const TYPES = "bool|float|int|uint|void|[biu]?vec[234]|mat[234](?:x[234])?|[iu]?sampler(?:2D|3D|Cube|2DArray)(?:Shadow)?";
const NUMBERS = "(?:0[xX][0-9a-fA-F]+|(?:\\d+\\.?\\d*|\\.\\d+)(?:[eE][+-]?\\d+)?)[uUfF]?";

const TOKEN = new RegExp(
  [
    "(?<comment>//[^\\n]*|/\\*[\\s\\S]*?(?:\\*/|$))",
    "(?<directive>#[^\\n]*)",
    `(?<number>(?<![\\w.])${NUMBERS})`,
    `(?<type>\\b(?:${TYPES})\\b)`,
    `(?<keyword>\\b(?:${KEYWORDS})\\b)`,
  ].join("|"),
  "g",
);

export function tokens(source: string): Token[] {
  const found: Token[] = [];
  let at = 0;
  for (const match of source.matchAll(TOKEN)) {
    if (match.index > at) found.push({ kind: "plain", text: source.slice(at, match.index) });
    const groups: Partial<Record<string, string>> = match.groups ?? {};
    const kind = KINDS.find((name) => groups[name] !== undefined) ?? "plain";
    found.push({ kind, text: match[0] });
    at = match.index + match[0].length;
  }
  if (at < source.length) found.push({ kind: "plain", text: source.slice(at) });
  return found;
}

/** The tokens of each line, with their line breaks. */
export function lines(source: string): Token[][] {
  const rows: Token[][] = [[]];
  for (const { kind, text } of tokens(source)) {
    // Splits after each line break, which stays with its line.
    for (const part of text.split(/(?<=\n)/)) {
      rows.at(-1)?.push({ kind, text: part });
      if (part.endsWith("\n")) rows.push([]);
    }
  }
  if (rows.at(-1)?.length === 0) rows.pop();
  return rows;
}
