/** Result sections: the selected quality, the time budget, pass times, benefit of each setting, table of all qualities. */
import { batch } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { Table } from "../charts/parts";
import { labelOf } from "../panel/model";
import { RangeInput } from "../ui/controls";
import { compare, formatNumber, formatSigned, measuredHere, median, type QualityResult, ranked } from "./measure/measured";
import { type Benefit, benefits, budgetAt, budgetRange, choose, DEFAULT_BUDGET, NEGLIGIBLE, predict, SLIDER_STEPS, stepOf } from "./measure/budget";
import type { BenchmarkRun, Session } from "./session";

/** Classes that the benchmark's parts share. */
export const QUIET = "min-h-11 rounded-lg px-3 text-soft hover:bg-hover hover:text-ink";
export const NUMBER = "min-h-11 w-[9ch] rounded-lg bg-hover px-2 text-right";

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
            <dd><b class="text-[16px] font-medium">{value}</b> {unit}</dd>
          </div>
        ))}
      </dl>
      {!isCurrent && <p class="text-fine text-dim">The current quality was not measured.</p>}
    </section>
  );
}

/** A slider and a field for the frame budget; both pick a quality at once. */
export function BudgetForm({ session, run }: { session: Session; run: BenchmarkRun }) {
  const [budget, setBudget] = useState(DEFAULT_BUDGET);
  const page = session.viewport.timing();
  const [width, height] = [Math.round(page.width / page.scale), Math.round(page.height / page.scale)];
  const predicted = predict(run.result, width, height);
  const range = budgetRange(predicted);
  const pick = (value: number) => {
    if (!(value > 0)) return;
    setBudget(value);
    const choice = choose(predicted, value, width, height);
    if (choice === null) return;
    batch(() => {
      session.select(choice.id);
      session.choice.value = choice;
    });
  };
  const choice = session.choice.value;
  const step = stepOf(budget, range);
  return (
    <section class="flex flex-wrap items-center gap-x-3.5 border-t border-line py-3" aria-label="Time budget">
      <label for="budget">Frame budget</label>
      <RangeInput class="min-w-15 flex-1" label="Budget slider" text={`${budget} ms`} value={step} min={0} max={SLIDER_STEPS} step={1} choose={(at) => pick(budgetAt(at, range))} />
      <span class="flex items-center gap-2">
        <input id="budget" class={NUMBER} type="number" inputMode="decimal" min={0.01} step="any" value={budget} onChange={(event) => pick(event.currentTarget.valueAsNumber)} />
        <span>ms</span>
      </span>
      <p class="budget-message basis-full text-fine text-soft" role="status">
        {choice && (
          <>
            Selected <b class="text-accent">{choice.label}</b>: {choice.reason}
          </>
        )}
      </p>
    </section>
  );
}

export function Disclosure({ title, note, open, children }: { title: string; note: string; open?: boolean; children: ComponentChildren }) {
  return (
    <details class="disclosure" open={open}>
      <summary><span>{title}</span><span class="ml-auto text-fine text-dim">{note}</span></summary>
      <div>{children}</div>
    </details>
  );
}

export function Passes({ passes }: QualityResult) {
  const total = passes.reduce((sum, { time }) => sum + time, 0);
  return (
    <Disclosure title="Time by pass" note={`${passes.length} ${passes.length === 1 ? "pass" : "passes"}`}>
      <ol class="passes mb-3 text-fine text-soft">
        {passes.toSorted((a, b) => b.time - a.time).map(({ name, time }) => (
          <li key={name} class="flex justify-between bg-linear-to-r from-teal to-teal bg-(length:--size) bg-bottom-left bg-no-repeat py-1.5" style={{ "--size": `${(100 * time) / total}% 2px` }}>
            <span>{name}</span>
            <span>{formatNumber(time)} ms</span>
          </li>
        ))}
      </ol>
    </Disclosure>
  );
}

export function Benefits({ standard, measured, session }: { standard: QualityResult; measured: readonly QualityResult[]; session: Session }) {
  return (
    <Disclosure title="Benefit of each setting" note="error removed per added ms" open>
      <Table class="mb-2.5" heads={["setting", "ms added", "error removed", "per ms"]}>
        {benefits(measuredHere(standard), measured.map(measuredHere)).map((benefit) => (
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
  return (
    <Disclosure title="All qualities" note={`${measured.length + unsupported.length}`}>
      <Table class="mb-2.5" heads={["quality", "ms", "RMSE", "FLIP", "max", "foam %"]}>
        {ranked(measured.map(measuredHere), "rmse")
          .sort((a, b) => a.time - b.time)
          .map(({ id, point, time, low, high, errors, onFront }) => (
            <tr key={id} data-id={id} class={id === highlighted ? "bg-tint" : ""} aria-current={point === current?.point ? "true" : undefined}>
              <th scope="row">
                <SelectButton id={id} label={point.label} note={onFront ? "on the Pareto front" : ""} session={session} />
              </th>
              <td title={`quartiles ${formatNumber(low)} to ${formatNumber(high)} ms`}>{formatNumber(time)}</td>
              <td>{formatNumber(errors.rmse)}</td>
              <td>{errors.flip.toFixed(3)}</td>
              <td>{formatNumber(errors.max)}</td>
              <td>{percent(errors.coverage)}</td>
            </tr>
          ))}
        {unsupported.map(({ point, reason }) => (
          <tr class="opacity-75" key={point.id}><th scope="row">{point.label}</th><td colSpan={5}>{reason}</td></tr>
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
