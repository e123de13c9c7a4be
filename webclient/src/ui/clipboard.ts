/**
 * Copies text. A page over plain HTTP, but for localhost, has no `navigator.clipboard`, and an embedded one may not
 * use it: there the browser's older command copies a selection. Rejects where neither copies.
 */
export async function copyText(text: string): Promise<void> {
  // Absent on such pages, whatever the types say.
  const { clipboard } = navigator as { clipboard?: Clipboard };
  const written = await clipboard?.writeText(text).then(
    () => true,
    () => false,
  );
  if (written) return;
  const focused = document.activeElement;
  const area = document.createElement("textarea");
  area.value = text;
  area.readOnly = true;
  Object.assign(area.style, { position: "fixed", inset: "0 auto auto 0", opacity: "0" });
  // What lies outside of an open dialog cannot be selected.
  (focused?.closest("dialog") ?? document.body).append(area);
  area.select();
  // eslint-disable-next-line @typescript-eslint/no-deprecated -- nothing else copies there
  const copied = document.execCommand("copy");
  area.remove();
  if (focused instanceof HTMLElement) focused.focus();
  if (!copied) throw new Error("The browser does not copy here. Select the text to copy it.");
}
