/** Insets of equal time and of equal error beside the reference, and a loupe that shows the numbers of one pixel in all of them. */
import { useMemo } from "preact/hooks";
import { Canvas, Table } from "../../charts/parts";
import { formatNumber } from "../measure/statistics";
import type { QualityResult } from "../measure/benchmark";
import { errorAtPixel, errorMap } from "../measure/errors";
import { measuredHere } from "../measure/measured";
import type { Picture } from "../measure/picture";
import { NUMBER, QUIET } from "../sections";
import type { BenchmarkRun, Session } from "../session";
import { drawPicture, equalError, equalTime, type Pixel, type Region, regionAround, worstPixel } from "./pictures";

interface Inset {
  title: string;
  /** Quality and its cost, or why there is none. */
  note: string;
  picture: Picture | null;
}

const CHANNELS = ["R", "G", "B", "foam"] as const;
const ARROWS: Record<string, readonly [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export function InsetsView({ session, run, shown, standard }: { session: Session; run: BenchmarkRun; shown: QualityResult; standard: QualityResult }) {
  const { truth } = run.input;
  const start = useMemo(() => worstPixel(errorMap(standard.picture, truth), truth.width), [standard, truth]);
  const at = session.loupe.value ?? start;
  const region = regionAround(at, truth.width, truth.height);
  const move = ({ x, y }: Pixel) => {
    if (!Number.isFinite(x) || !Number.isFinite(y)) return;
    session.loupe.value = { x: Math.min(truth.width - 1, Math.max(0, x)), y: Math.min(truth.height - 1, Math.max(0, y)) };
  };
  const insets = insetsOf(shown, run);
  return (
    <section class="border-t border-line py-3" aria-label="Insets">
      <div
        class="insets grid grid-cols-2 gap-2.5 group-[.wide]/panel:grid-cols-4 phone:grid-cols-2!"
        role="group"
        tabIndex={0}
        aria-label="Insets of one place. Arrow keys move the loupe."
        onKeyDown={(event) => {
          const arrow = ARROWS[event.key];
          if (arrow === undefined || event.target !== event.currentTarget) return;
          event.preventDefault();
          move({ x: at.x + arrow[0], y: at.y + arrow[1] });
        }}
      >
        {insets.map((inset) => <InsetFigure key={inset.title} inset={inset} region={region} at={at} move={move} />)}
      </div>
      <div class="flex flex-wrap items-center gap-x-3.5 gap-y-1.5 pt-2.5 pb-1.5 text-fine">
        {(["x", "y"] as const).map((axis) => (
          <label key={axis}>
            {axis === "x" ? "Column" : "Row"}
            <input
              type="number"
              class={`${NUMBER} ml-2`}
              min={0}
              max={(axis === "x" ? truth.width : truth.height) - 1}
              value={at[axis]}
              onInput={(event) => move({ ...at, [axis]: event.currentTarget.valueAsNumber })}
            />
          </label>
        ))}
        <button type="button" class={QUIET} onClick={() => move(worstPixel(errorMap(shown.picture, truth), truth.width))}>
          Worst pixel
        </button>
      </div>
      <Floats insets={insets} truth={truth} at={at} />
    </section>
  );
}

function insetsOf(shown: QualityResult, { result: { measured }, input: { truth } }: BenchmarkRun): Inset[] {
  const timed = (result: QualityResult) => ({ ...measuredHere(result), picture: result.picture });
  const all = measured.map(timed);
  const chosen = timed(shown);
  const inset = (title: string, found: typeof chosen | null, none: string): Inset => ({
    title,
    note: found ? `${found.point.label}: ${formatNumber(found.time)} ms, RMSE ${formatNumber(found.error)}` : none,
    picture: found?.picture ?? null,
  });
  return [
    inset("Selected", chosen, ""),
    inset("Equal time", equalTime(chosen, all), "No other quality is as fast."),
    inset("Equal error", equalError(chosen, all), "No other quality is as exact."),
    { title: "Reference", note: "float64", picture: truth },
  ];
}

function InsetFigure({ inset: { title, note, picture }, region, at, move }: { inset: Inset; region: Region; at: Pixel; move: (at: Pixel) => void }) {
  const { x, y, width, height } = region;
  const follow = (event: PointerEvent) => {
    if (!(event.currentTarget instanceof HTMLElement)) return;
    const box = event.currentTarget.getBoundingClientRect();
    const pixel = (place: number, start: number, side: number, first: number, count: number) =>
      first + Math.min(count - 1, Math.max(0, Math.floor(((place - start) / side) * count)));
    move({ x: pixel(event.clientX, box.left, box.width, x, width), y: pixel(event.clientY, box.top, box.height, y, height) });
  };
  const share = (pixel: number, first: number, count: number) => `${(100 * (pixel - first)) / count}%`;
  return (
    <figure>
      <div class={`relative cursor-crosshair touch-pan-y overflow-hidden rounded-sm bg-[#05090f] ${picture ? "" : "none"}`} style={{ aspectRatio: `${width} / ${height}` }} {...(picture ? { onPointerDown: follow } : {})}>
        {picture && <Canvas class="absolute inset-0 size-full [image-rendering:pixelated]" label={`${title}: ${note}`} paint={(canvas) => drawPicture(canvas, picture, region)} shows={[picture, x, y, width, height]} />}
        {picture && (
          <i class="absolute shadow-[0_0_0_3px_rgb(0_0_0/60%)] outline-[1.5px] outline-[#fff]" style={{ left: share(at.x, x, width), top: share(at.y, y, height), width: `${100 / width}%`, height: `${100 / height}%` }} />
        )}
      </div>
      <figcaption class="pt-1 text-fine/[1.3]">
        <b class="block">{title}</b>
        <span class="block text-soft">{note}</span>
      </figcaption>
    </figure>
  );
}

/** The linear values under the loupe, and each picture's error there. */
function Floats({ insets, truth, at }: { insets: readonly Inset[]; truth: Picture; at: Pixel }) {
  const pixel = at.y * truth.width + at.x;
  return (
    <Table class="floats mb-2.5" label={`Linear light at column ${at.x}, row ${at.y}`} heads={["pixel", ...CHANNELS, "error"]}>
      {insets.map(
        ({ title, picture }) =>
          picture && (
            <tr key={title}>
              <th scope="row">{title}</th>
              {CHANNELS.map((name, c) => <td key={name}>{(picture.pixels[4 * pixel + c] ?? NaN).toFixed(5)}</td>)}
              <td>{picture === truth ? "–" : formatNumber(errorAtPixel(picture, truth, pixel))}</td>
            </tr>
          ),
      )}
    </Table>
  );
}
