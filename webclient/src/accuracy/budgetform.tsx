/** A slider and a field for the frame budget; both pick a quality at once. */
import { batch } from "@preact/signals";
import { useState } from "preact/hooks";
import { budgetAt, budgetRange, choose, DEFAULT_BUDGET, predict, SLIDER_STEPS, stepOf } from "./measure/budget";
import { NUMBER } from "./sections";
import type { BenchmarkRun, Session } from "./session";

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
      <input
        type="range"
        class="min-w-15 flex-1"
        aria-label="Budget slider"
        aria-valuetext={`${budget} ms`}
        style={{ "--share": `${(100 * step) / SLIDER_STEPS}%` }}
        min={0}
        max={SLIDER_STEPS}
        value={step}
        onInput={(event) => pick(budgetAt(event.currentTarget.valueAsNumber, range))}
      />
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
