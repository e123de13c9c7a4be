/** A quality's picture beside its error map or the reference, the error's spectrum, insets of equal time and of equal error, and a loupe. */
import { useMemo, useState } from "preact/hooks";
import { INK, type Line, LineChart } from "../../charts/linechart";
import { Canvas, Table } from "../../charts/parts";
import { errorAtPixel, errorMap, luminance, percentile, type Picture, radialSpectrum } from "../measure/errors";
import { formatNumber, measuredHere, type QualityResult } from "../measure/measured";
import { Disclosure, NUMBER, QUIET } from "../sections";
import type { BenchmarkRun, Session } from "../session";
import { drawErrors, drawPicture, equalError, equalTime, HEAT_GRADIENT, type Pixel, type Region, regionAround, worstPixel } from "./pictures";

const LEGEND_PERCENTILE = 0.97; // The colour scale ends at this percentile of the standard quality's errors

const LAYER = "absolute inset-0 size-full [image-rendering:pixelated]";

const SIDES = ["error", "reference"] as const;

export function ErrorView({ shown, standard, truth }: { shown: QualityResult; standard: QualityResult; truth: Picture }) {
  const [side, setSide] = useState<(typeof SIDES)[number]>("error");
  const [split, setSplit] = useState("50");
  const { picture, point } = shown;
  const { width, height } = truth;
  // The same scale for all qualities, so that they can be compared.
  const max = useMemo(() => roundUp(percentile(errorMap(standard.picture, truth), LEGEND_PERCENTILE)), [standard, truth]);
  const paintRight = (canvas: HTMLCanvasElement) => {
    if (side === "error") drawErrors(canvas, width, height, errorMap(picture, truth), max);
    else drawPicture(canvas, truth);
  };
  return (
    <figure class="border-t border-line py-3">
      <figcaption class="flex items-center justify-between gap-2.5">
        <span class="text-fine text-soft">{point.label}</span>
        <div class="toggle" role="group" aria-label="Compare with">
          {SIDES.map((name) => (
            <button type="button" class="min-h-11 px-3 text-dim aria-pressed:text-ink aria-pressed:underline aria-pressed:decoration-accent aria-pressed:decoration-2 aria-pressed:underline-offset-[7px]" key={name} aria-pressed={name === side} onClick={() => setSide(name)}>
              {name}
            </button>
          ))}
        </div>
      </figcaption>
      <div class="frame relative overflow-hidden rounded-lg" style={{ "--at": `${split}%`, aspectRatio: `${width} / ${height}` }}>
        <Canvas class={LAYER} label={`Picture at quality ${point.label}`} paint={(canvas) => drawPicture(canvas, picture)} shows={[picture]} />
        <Canvas class={`right ${LAYER} [clip-path:inset(0_0_0_var(--at))]`} label={side === "error" ? `Error map, 0 to ${max} levels` : "Float64 reference"} paint={paintRight} shows={[side, picture, truth, max]} />
        <div class="absolute inset-y-0 left-(--at) w-px bg-[#fff]" />
        <input class="absolute inset-0 size-full touch-pan-y [--track:none]" type="range" min={0} max={100} step={1} value={split} aria-label="Split position" onInput={(event) => setSplit(event.currentTarget.value)} />
      </div>
      <div class={`flex items-center justify-between gap-2.5 pt-2 text-fine text-soft ${side === "error" ? "" : "invisible"}`} style={{ "--ramp": HEAT_GRADIENT }}>
        <span>0</span>
        <i class="h-2 flex-1 rounded-[4px] bg-(image:--ramp)" />
        <span>{`≥ ${max} levels of 255`}</span>
      </div>
    </figure>
  );
}

/** The spectrum of a quality's error beside that of the standard quality and of the reference itself. */
export function SpectrumView({ shown, standard, truth }: { shown: QualityResult; standard: QualityResult; truth: Picture }) {
  const { x, lines } = useMemo(() => {
    const { width, height } = truth;
    const reference = radialSpectrum(luminance(truth), width, height);
    const line = (label: string, colour: string, picture: Picture): Line => {
      return { label, colour, values: radialSpectrum(luminance(picture, truth), width, height).power };
    };
    const others = shown === standard ? [] : [line(`error of ${standard.point.label}`, INK.teal, standard.picture)];
    const own: Line = { label: "the reference itself", colour: INK.pale, dashed: true, values: reference.power };
    return { x: reference.frequency, lines: [line(`error of ${shown.point.label}`, INK.accent, shown.picture), ...others, own] };
  }, [shown, standard, truth]);
  return (
    <Disclosure title="Spectrum of the error" note="power by frequency" open>
      <LineChart title={`Power spectrum of the error of ${shown.point.label}`} x={x} lines={lines} xLabel="cycles per pixel" yLabel="power, levels²" />
    </Disclosure>
  );
}

/** Next number of 1, 2 or 5 times a power of ten. */
function roundUp(value: number): number {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return ([1, 2, 5].find((step) => step * power >= value) ?? 10) * power;
}

/** `note`: quality and its cost, or why there is none. */
interface Inset { title: string; note: string; picture: Picture | null; }

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
