/** The widget for notebooks (server/seafoam/notebook): anywidget calls `render` for each view of it. */
import type { Model } from "./kernel";
import { WaterView } from "./water";

function render({ model, el }: { model: Model; el: HTMLElement }): () => void {
  const view = new WaterView(model, el);
  return () => view.dispose();
}

export default { render };
