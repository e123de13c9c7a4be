/** Pictures dropped on the page. */

/** Calls `restore` with each picture that is dropped; other files and texts are left to the browser. */
export function listenForDrops(target: Window, restore: (file: File) => void): void {
  const hasFile = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  target.addEventListener("dragover", (event) => {
    // Without this the browser opens the file.
    if (hasFile(event)) event.preventDefault();
  });
  target.addEventListener("drop", (event) => {
    if (!hasFile(event)) return;
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (file) restore(file);
  });
}
