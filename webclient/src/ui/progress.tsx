/** A bar of what is done: `share` 0 to 1, or null while that is not known. */
export function Progress({ label, share, class: more }: { label: string; share: number | null; class?: string }) {
  const bar = "h-[3px] w-full appearance-none bg-track [&::-moz-progress-bar]:bg-accent [&::-webkit-progress-bar]:bg-transparent [&::-webkit-progress-value]:bg-accent";
  return <progress class={`${more ?? ""} ${bar}`} max={1} aria-label={label} {...(share === null ? {} : { value: share })} />;
}
