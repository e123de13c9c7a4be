/** Classes of what the benchmark's parts share. */

export const QUIET = "min-h-11 rounded-lg px-3 text-soft hover:bg-hover hover:text-ink";
export const NUMBER = "min-h-11 w-[9ch] rounded-lg bg-hover px-2 text-right";
