/** Classes of a table of numbers. */
export const TABLE =
  "w-full text-note [&_:is(th,td)]:py-0.5 [&_:is(th,td)]:pl-2 [&_:is(th,td)]:text-right [&_:is(th,td)]:font-normal [&_th:first-child]:pl-0 [&_th:first-child]:text-left " +
  "[&_thead_th]:text-fine [&_thead_th]:text-dim [&_tbody_tr]:border-t [&_tbody_tr]:border-hover [&_tbody_tr]:text-soft [&_tbody_tr]:hover:bg-hover [&_tr[aria-current]]:text-accent";
