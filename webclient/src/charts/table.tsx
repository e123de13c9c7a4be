/** Tables, of numbers unless they look otherwise. */
import type { ComponentChildren } from "preact";

const TABLE =
  "w-full text-note [&_:is(th,td)]:py-0.5 [&_:is(th,td)]:pl-2 [&_:is(th,td)]:text-right [&_:is(th,td)]:font-normal [&_th:first-child]:pl-0 [&_th:first-child]:text-left " +
  "[&_thead_th]:text-fine [&_thead_th]:text-dim [&_tbody_tr]:border-t [&_tbody_tr]:border-hover [&_tbody_tr]:text-soft [&_tbody_tr]:hover:bg-hover [&_tr[aria-current]]:text-accent";

interface TableProps {
  heads: readonly string[];
  class?: string;
  /** Classes of rows and cells. */
  look?: string;
  label?: string;
  children: ComponentChildren;
}

export function Table({ heads, class: more = "", look = TABLE, label, children }: TableProps) {
  return (
    <table class={`${more} ${look}`} aria-label={label}>
      <thead><tr>{heads.map((head, i) => <th scope="col" key={i}>{head}</th>)}</tr></thead>
      <tbody>{children}</tbody>
    </table>
  );
}
