/** Classes of what the benchmark's parts share. */

export const QUIET = "min-h-11 rounded-lg px-3 text-soft hover:bg-hover hover:text-ink";
export const NUMBER = "min-h-11 w-[9ch] rounded-lg bg-hover px-2 text-right";
export const TABLE =
  "mb-2.5 w-full text-note [&_:is(th,td)]:py-0.5 [&_:is(th,td)]:pl-2 [&_:is(th,td)]:text-right [&_:is(th,td)]:font-normal [&_th:first-child]:pl-0 [&_th:first-child]:text-left " +
  "[&_thead_th]:text-fine [&_thead_th]:text-dim [&_tbody_tr]:border-t [&_tbody_tr]:border-hover [&_tbody_tr]:text-soft [&_tbody_tr]:hover:bg-hover [&_tr[aria-current]]:text-accent";
