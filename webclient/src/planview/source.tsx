/** The GLSL of a program, as the driver has it, coloured, with the names of its files. */
import { useMemo } from "preact/hooks";
import type { FramePlan, Shader } from "../generated/api";
import type { Executor } from "../plan/executor";
import { Pills } from "../surfaces/parts";
import { Select } from "../ui/controls";

const KINDS = ["comment", "directive", "keyword", "type", "number"] as const;

type TokenKind = (typeof KINDS)[number] | "plain";

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

const STAGES = ["vertex", "fragment"] as const;
export type Stage = (typeof STAGES)[number];

/** Its number, and on the right the name of the file that begins here; neither is part of the text. */
const LINE =
  "line relative block [counter-increment:line] before:mr-[2ch] before:inline-block before:w-[5ch] before:text-right before:text-faint before:content-[counter(line)] " +
  "data-file:mt-2.5 data-file:border-t data-file:border-line data-file:after:absolute data-file:after:top-0 data-file:after:right-0 data-file:after:bg-sheet data-file:after:pl-3 " +
  "data-file:after:text-accent data-file:after:content-[attr(data-file)]";

const COLOURS: Record<TokenKind, string> = {
  plain: "",
  comment: "text-[#8fa9b5]",
  directive: "text-[#d3a6e0]",
  keyword: "keyword text-accent",
  type: "text-[#8fd0ef]",
  number: "text-[#a8dca0]",
};

interface SourceProps {
  plan: FramePlan;
  executor: Executor | null;
  gl: WebGL2RenderingContext | null; // Null where the server draws
  program: string;
  stage: Stage;
  choose: (program: string, stage: Stage) => void;
}

/** The driver's text, or the plan's where the program is not compiled. */
function sourceOf({ executor, gl, program, stage }: SourceProps, shader: Shader): { text: string; compiled: boolean } {
  const held = executor?.programs.get(program);
  const text = held && gl ? gl.getShaderSource(held[stage]) : null;
  return text === null ? { text: shader.text, compiled: false } : { text, compiled: true };
}

function Listing({ text, shader }: { text: string; shader: Shader }) {
  const rows = useMemo(() => lines(text), [text]);
  const files = new Map(shader.files.map(({ path, line }) => [line, path]));
  return (
    <pre class="glsl max-h-[60vh] [counter-reset:line]" tabIndex={0} aria-label="GLSL">
      <code>
        {rows.map((row, index) => (
          <span class={LINE} key={index} data-file={files.get(index + 1)}>
            {row.map(({ kind, text: part }, i) => (kind === "plain" ? part : <span key={i} class={COLOURS[kind]}>{part}</span>))}
          </span>
        ))}
      </code>
    </pre>
  );
}

export function Source(props: SourceProps) {
  const { plan, program, stage, choose } = props;
  const found = plan.programs[program];
  if (found === undefined) return null;
  const shader = found[stage];
  const { text, compiled } = sourceOf(props, shader);
  return (
    <section>
      <div class="pills">
        <label>
          Program{" "}
          <Select
            class="min-h-11 rounded-lg border border-line bg-[#0c1a25] px-3"
            label="Program"
            value={program}
            options={Object.keys(plan.programs).map((name) => [name, name] as const)}
            choose={(name) => choose(name, stage)}
          />
        </label>
        <Pills names={STAGES} chosen={stage} choose={(name) => choose(program, name)} />
      </div>
      <p>
        {compiled ? "As the driver has it" : "As the plan has it: this camera does not need the program, so it is not compiled"}. {shader.files.length} files,{" "}
        {new TextEncoder().encode(text).length.toLocaleString("en")} bytes, SHA-256 <code>{shader.sha256.slice(0, 12)}…</code>
      </p>
      <Listing text={text} shader={shader} />
    </section>
  );
}
