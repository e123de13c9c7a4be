/** Result sections: the selected quality, pass times, benefit of each setting, table of all qualities. */
import type { ComponentChildren } from "preact";
import { TABLE } from "../charts/table";
import { labelOf } from "../panel/model";
import { marksOf, measuredHere } from "./diagram/diagramdata";
import { formatNumber, formatSigned } from "./format";
import type { QualityResult } from "./measure/benchmark";
import { type Benefit, benefits, NEGLIGIBLE } from "./measure/benefit";
import { compare, median, quantile } from "./measure/statistics";
import type { BenchmarkRun, Session } from "./session";

const costOf = ({ point, rounds, errors }: QualityResult) => ({ id: point.id, time: median(rounds), error: errors.rmse });
const percent = (share: number) => (100 * share).toFixed(1);

export function Selected({ shown, standard, isCurrent }: { shown: QualityResult; standard: QualityResult; isCurrent: boolean }) {
  const { point, errors, rounds } = shown;
  const { summary } = compare(standard.rounds, rounds, standard.errors.rmse, errors.rmse);
  const figures = [
    ["frame time", formatNumber(median(rounds)), "ms"],
    ["RMSE", formatNumber(errors.rmse), "levels"],
    ["FLIP", errors.flip.toFixed(3), ""],
    ["maximum", formatNumber(errors.max), "levels"],
    ["foam coverage", percent(errors.coverage), "%"],
  ];
  return (
    <section class="selected border-t border-line py-3" aria-live="polite">
      <h3 class="font-serif text-[21px]/[1.2] first-letter:uppercase">{point.label}</h3>
      <p class="sentence text-accent">
        {point === standard.point ? "Other qualities are compared with this one." : `Compared with ${standard.point.label}: ${summary}.`}
      </p>
      <dl class="flex flex-wrap justify-between gap-x-3.5 gap-y-1 pt-2.5 text-fine">
        {figures.map(([name, value, unit]) => (
          <div key={name}>
            <dt class="text-dim">{name}</dt>
            <dd>
              <b class="text-[16px] font-medium">{value}</b> {unit}
            </dd>
          </div>
        ))}
      </dl>
      {!isCurrent && <p class="text-fine text-dim">The current quality was not measured.</p>}
    </section>
  );
}

export function Disclosure({ title, note, open, children }: { title: string; note: string; open?: boolean; children: ComponentChildren }) {
  return (
    <details class="disclosure" open={open}>
      <summary>
        <span>{title}</span>
        <span class="ml-auto text-fine text-dim">{note}</span>
      </summary>
      <div>{children}</div>
    </details>
  );
}

export function Passes({ passes }: QualityResult) {
  const total = passes.reduce((sum, { time }) => sum + time, 0);
  return (
    <Disclosure title="Time by pass" note={`${passes.length} ${passes.length === 1 ? "pass" : "passes"}`}>
      <ol class="passes mb-3 text-fine text-soft">
        {[...passes]
          .sort((a, b) => b.time - a.time)
          .map(({ name, time }) => (
            <li key={name} class="flex justify-between bg-linear-to-r from-teal to-teal bg-(length:--size) bg-bottom-left bg-no-repeat py-1.5" style={{ "--size": `${(100 * time) / total}% 2px` }}>
              <span>{name}</span>
              <span>{formatNumber(time)} ms</span>
            </li>
          ))}
      </ol>
    </Disclosure>
  );
}

function Table({ heads, children }: { heads: readonly string[]; children: ComponentChildren }) {
  return (
    <table class={`mb-2.5 ${TABLE}`}>
      <thead>
        <tr>
          {heads.map((name) => (
            <th scope="col" key={name}>
              {name}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>{children}</tbody>
    </table>
  );
}

export function Benefits({ standard, measured, session }: { standard: QualityResult; measured: readonly QualityResult[]; session: Session }) {
  const timed = (result: QualityResult) => ({ ...costOf(result), point: result.point, rounds: result.rounds });
  return (
    <Disclosure title="Benefit of each setting" note="error removed per added ms" open>
      <Table heads={["setting", "ms added", "error removed", "per ms"]}>
        {benefits(timed(standard), measured.map(timed)).map((benefit) => (
          <BenefitRow key={benefit.id} benefit={benefit} session={session} />
        ))}
      </Table>
    </Disclosure>
  );
}

function BenefitRow({ benefit: { id, title, owner, cause, from, to, added, measurable, removed, perMs }, session }: { benefit: Benefit; session: Session }) {
  const useless = removed < NEGLIGIBLE;
  return (
    <tr data-id={id} class={useless ? "opacity-75" : ""}>
      <th scope="row" title={`${labelOf(owner)}, affects ${cause}`}>
        <SelectButton id={id} label={title} note={`${from} → ${to}`} session={session} />
      </th>
      <td>{measurable ? formatSigned(added) : "≈ 0"}</td>
      <td>{formatSigned(removed)}</td>
      <td class="per-ms">{perMs === null ? (useless ? "–" : "free") : formatSigned(perMs)}</td>
    </tr>
  );
}

/** The diagram's alternative: every number that it shows. */
export function AllQualities({ run, session }: { run: BenchmarkRun; session: Session }) {
  const { measured, unsupported } = run.result;
  const current = session.current.value;
  const highlighted = session.highlighted.value;
  const front = new Set(marksOf(measured.map(measuredHere), "rmse").flatMap(({ id, onFront }) => (onFront ? id : [])));
  return (
    <Disclosure title="All qualities" note={`${measured.length + unsupported.length}`}>
      <Table heads={["quality", "ms", "RMSE", "FLIP", "max", "foam %"]}>
        {[...measured]
          .sort((a, b) => median(a.rounds) - median(b.rounds))
          .map(({ point, rounds, errors }) => (
            <tr key={point.id} data-id={point.id} class={point.id === highlighted ? "bg-tint" : ""} aria-current={point === current?.point ? "true" : undefined}>
              <th scope="row">
                <SelectButton id={point.id} label={point.label} note={front.has(point.id) ? "on the Pareto front" : ""} session={session} />
              </th>
              <td title={`quartiles ${formatNumber(quantile(rounds, 0.25))} to ${formatNumber(quantile(rounds, 0.75))} ms`}>{formatNumber(median(rounds))}</td>
              <td>{formatNumber(errors.rmse)}</td>
              <td>{errors.flip.toFixed(3)}</td>
              <td>{formatNumber(errors.max)}</td>
              <td>{percent(errors.coverage)}</td>
            </tr>
          ))}
        {unsupported.map(({ point, reason }) => (
          <tr class="opacity-75" key={point.id}>
            <th scope="row">{point.label}</th>
            <td colSpan={5}>{reason}</td>
          </tr>
        ))}
      </Table>
    </Disclosure>
  );
}

function SelectButton({ id, label, note, session }: { id: string; label: string; note: string; session: Session }) {
  return (
    <>
      <button type="button" class="min-h-11 w-full py-1 text-left first-letter:uppercase" title={`Select ${label}`} onClick={() => session.select(id)}>
        {label}
      </button>
      {note !== "" && <span class="-mt-2 block pb-1.5 text-small text-dim">{note}</span>}
    </>
  );
}
